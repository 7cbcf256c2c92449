#pragma once

#include <sys/types.h>

#include <string>

namespace sphparam {

/// Folders in which items are worked on, named by the process that does it:
/// "ID~HOST.MACHINE~BOOT~SPACE~PID~START", so that every process of this machine can tell whether
/// it lives. MACHINE: by its /etc/machine-id, as two may have one name; empty where it has none.
std::string staging_name(const std::string& id);
/// The same of another process, which has not been waited for.
std::string staging_name(const std::string& id, pid_t process);

enum class StagingOwner { Lives, IsGone, Unknown };

/// Unknown: another machine's, another container's, or from before a start of a machine that has no
/// number.
StagingOwner owner_of_staging(const std::string& name);

/// Removes what processes of this machine left that are no more. Returns how many.
int remove_left_staging(const std::string& folder);

/// Folders whose owners live, or may live elsewhere.
int count_staging(const std::string& folder);

/// Of this machine, as records name it.
const std::string& host_name();

}  // namespace sphparam
