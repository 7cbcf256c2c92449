#pragma once

#include <sys/stat.h>

#include <string>

namespace sphparam {

/// Gives a new file what the file it replaces has: permissions and, as far as the user may give
/// them, owner, group, ACL and the attributes user.* (not those of security modules, nor times,
/// nor other names of the old file: they keep the old bytes). Who may not give the group away
/// leaves the new one no more than everybody had; the bits of setuid and setgid go with owner and
/// group only. What a file system does not have is left out.
void hand_on(const std::string& old_file, const struct stat& old_status, int new_file);

}  // namespace sphparam
