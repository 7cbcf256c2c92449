#include "io/files/handed_on.h"

#include <sys/xattr.h>
#include <unistd.h>

#include <string_view>
#include <vector>

namespace sphparam {
namespace {

constexpr const char* acl = "system.posix_acl_access";

/// Names, each ended by zero; empty where there are none.
std::string names_of_attributes(const std::string& path) {
  const ssize_t size = ::listxattr(path.c_str(), nullptr, 0);
  std::string names(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  const ssize_t filled = names.empty() ? 0 : ::listxattr(path.c_str(), names.data(), names.size());
  names.resize(filled > 0 ? static_cast<std::size_t>(filled) : 0);
  return names;
}

void copy_attribute(const std::string& path, const char* name, int new_file) {
  const ssize_t size = ::getxattr(path.c_str(), name, nullptr, 0);
  if (size < 0) return;
  std::vector<char> value(static_cast<std::size_t>(size));
  const ssize_t filled = ::getxattr(path.c_str(), name, value.data(), value.size());
  if (filled < 0) return;
  static_cast<void>(::fsetxattr(new_file, name, value.data(), static_cast<std::size_t>(filled), 0));
}

/// The mode that gives a new owner or group nothing that was meant for the old ones.
mode_t mode_for(mode_t mode, bool owner_kept, bool group_kept) {
  if (!owner_kept) mode &= ~mode_t{S_ISUID};
  if (group_kept) return mode;
  const mode_t as_everybody = (mode & S_IRWXO) << 3;
  return mode & ~(mode_t{S_ISGID} | (S_IRWXG & ~as_everybody));
}

}  // namespace

void hand_on(const std::string& old_file, const struct stat& old_status, int new_file) {
  struct stat now {};
  const uid_t same_owner = static_cast<uid_t>(-1);
  if (::fstat(new_file, &now) != 0) return;
  const bool group_kept =
      now.st_gid == old_status.st_gid || ::fchown(new_file, same_owner, old_status.st_gid) == 0;
  const bool owner_kept = now.st_uid == old_status.st_uid ||
                          ::fchown(new_file, old_status.st_uid, static_cast<gid_t>(-1)) == 0;
  static_cast<void>(
      ::fchmod(new_file, mode_for(old_status.st_mode & 07777, owner_kept, group_kept)));
  static_cast<void>(::fremovexattr(new_file, acl));  // of the folder
  const std::string names = names_of_attributes(old_file);
  for (std::size_t at = 0; at < names.size();) {
    const std::string_view name(names.data() + at);
    if (name.starts_with("user.") || (name == acl && group_kept))
      copy_attribute(old_file, name.data(), new_file);
    at += name.size() + 1;
  }
}

}  // namespace sphparam
