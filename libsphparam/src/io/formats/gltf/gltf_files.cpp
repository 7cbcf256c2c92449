#include "io/formats/gltf/gltf_files.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include "sphparam/io/read_options.h"

// A URI is text from a stranger. It is refused when it could mean anything but a file next to the
// glTF file; the kernel then makes sure that no link leads out (openat2), or, where the kernel is
// older than that, the resolved path is compared with the resolved folder.

namespace sphparam {
namespace {

namespace fs = std::filesystem;

/// What may be done, as programs that look at what strangers send read nothing else.
constexpr char outside[] =
    "files outside of the mesh's folder are not read; copy it there, or pack all into one .glb";

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const std::string_view digits = uri.substr(i + 1, 2);
    const char* const end = digits.data() + digits.size();
    unsigned char byte = 0;
    if (digits.size() < 2 || std::from_chars(digits.data(), end, byte, 16).ptr != end)
      refuse("a percent sign that two hexadecimal digits do not follow");
    text += static_cast<char>(byte);
    i += 2;
  }
  return text;
}

struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

constexpr int open_flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;  // never waits for a pipe's writer

int open_by_resolved_path(const fs::path& folder, const fs::path& path) {
  std::error_code missing;
  const fs::path root = fs::canonical(folder, missing);
  if (missing) return -1;
  const fs::path target = fs::canonical(root / path, missing);
  if (missing) return -1;
  const auto [end_of_root, unused] =
      std::mismatch(root.begin(), root.end(), target.begin(), target.end());
  if (end_of_root != root.end()) {
    errno = EXDEV;
    return -1;
  }
  return ::open(target.c_str(), open_flags | O_NOFOLLOW);
}

int open_below(const fs::path& folder, const fs::path& path) {
  const Descriptor directory{::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)};
  if (directory.number < 0) return -1;
  open_how how{};
  how.flags = open_flags;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  const long opened = ::syscall(SYS_openat2, directory.number, path.c_str(), &how, sizeof how);
  if (opened >= 0 || (errno != ENOSYS && errno != EPERM)) return static_cast<int>(opened);
  return open_by_resolved_path(folder, path);
}

}  // namespace

fs::path path_of_uri(std::string_view uri) {
  const std::string text = percent_decoded(uri);
  if (text.empty()) refuse("an empty name");
  if (text.find(':') < text.find('/')) refuse("a scheme other than base64 data");
  if (text.find('\\') != std::string::npos) refuse("a backslash");
  const bool control =
      std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (control) refuse("a control character");
  const fs::path path(text);
  if (path.is_absolute()) refuse(std::string("an absolute path: ") + outside);
  if (std::find(path.begin(), path.end(), "..") != path.end())
    refuse(std::string("'..': ") + outside);
  return path;
}

std::vector<unsigned char> read_below(const fs::path& folder, const fs::path& path,
                                      std::uint64_t max_bytes) {
  const Descriptor file{open_below(folder.empty() ? fs::path(".") : folder, path)};
  if (file.number < 0)
    refuse(errno == EXDEV ? std::string("it leads out of the folder: ") + outside
                          : std::strerror(errno));
  struct stat status {};
  if (::fstat(file.number, &status) != 0) refuse(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) refuse("it is no regular file");
  if (static_cast<std::uint64_t>(status.st_size) > max_bytes)
    refuse("it is larger than the limit of " + std::to_string(max_bytes) + " bytes");

  std::vector<unsigned char> bytes(static_cast<std::size_t>(status.st_size));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = ::read(file.number, bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace sphparam
