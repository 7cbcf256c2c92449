#include "io/files/file_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

namespace sphparam {
namespace {

/// Closes a descriptor that this file opened, on every way out.
struct Descriptor {
  int number;
  bool owned;
  ~Descriptor() {
    if (owned) ::close(number);
  }
};

int open_to_read(const std::string& path) {
  for (;;) {
    const int number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (number >= 0 || errno != EINTR) return number;
  }
}

}  // namespace

FileBytes::FileBytes(const std::string& path, std::uint64_t max_bytes)
    : FileBytes(path, max_bytes, "the limit of " + std::to_string(max_bytes) + " bytes") {}

FileBytes::FileBytes(const std::string& path, const ReadOptions& options)
    : FileBytes(path, options.max_file_bytes, file_limit(options.max_file_bytes)) {}

FileBytes::FileBytes(const std::string& path, std::uint64_t max_bytes, std::string limit)
    : name_(path == "-" ? "standard input" : path), limit_(std::move(limit)) {
  const bool standard_input = path == "-";
  const Descriptor file{standard_input ? STDIN_FILENO : open_to_read(path), !standard_input};
  if (file.number < 0) throw ReadError(name_, std::strerror(errno));
  map_or_read(file.number, max_bytes);
}

FileBytes::FileBytes(int descriptor, std::string name) : name_(std::move(name)) {
  ::lseek(descriptor, 0, SEEK_SET);
  map_or_read(descriptor, std::numeric_limits<std::uint64_t>::max());
}

FileBytes::~FileBytes() {
  if (mapping_) ::munmap(mapping_, view_.size());
}

void FileBytes::map_or_read(int descriptor, std::uint64_t max_bytes) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) throw ReadError(name_, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw ReadError(name_, "is a directory");
  // A redirected standard input may be half read already, so its offset counts: read it instead.
  if (!S_ISREG(status.st_mode) || descriptor == STDIN_FILENO)
    return read_all(descriptor, max_bytes);

  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > max_bytes) throw ReadError(name_, "is larger than " + limit_);
  void* const mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, descriptor, 0);
  // No mapping has 0 bytes, which is what empty files have, and what those of /proc say.
  if (mapping == MAP_FAILED) return read_all(descriptor, max_bytes);
  mapping_ = mapping;
  view_ = {static_cast<const char*>(mapping), size};
}

void FileBytes::read_all(int descriptor, std::uint64_t max_bytes) {
  constexpr std::size_t first_block = 1 << 16;
  std::size_t filled = 0;
  const std::uint64_t one_too_many = std::min<std::uint64_t>(max_bytes, copy_.max_size() - 1) + 1;
  for (;;) {
    if (filled > max_bytes) throw ReadError(name_, "is larger than " + limit_);
    if (filled == copy_.size())
      copy_.resize(std::min<std::uint64_t>(one_too_many, std::max(first_block, 2 * filled)));
    const ssize_t count = ::read(descriptor, copy_.data() + filled, copy_.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw ReadError(name_, std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  copy_.resize(filled);
  view_ = copy_;
}

}  // namespace sphparam
