#pragma once

#include <sys/types.h>

#include <string>

namespace sphparam {

/// Folders in which items are worked on, named by the process that does it:
/// "ID~HOST~BOOT~SPACE~PID~START", so that every process of this machine can tell whether it lives.
std::string staging_name(const std::string& id);
/// The same of another process, which has not been waited for.
std::string staging_name(const std::string& id, pid_t process);

enum class StagingOwner { Lives, IsGone, Unknown };

/// Unknown: another machine's, or another container's.
StagingOwner owner_of_staging(const std::string& name);

/// Removes what processes of this machine left that are no more. Returns how many.
int remove_left_staging(const std::string& folder);

/// Folders whose owners live, or may live elsewhere.
int count_staging(const std::string& folder);

/// Of this machine, as records name it.
const std::string& host_name();

}  // namespace sphparam
