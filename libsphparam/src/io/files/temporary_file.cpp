#include "io/files/temporary_file.h"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>
#include <random>
#include <utility>

#include "io/files/handed_on.h"
#include "sphparam/io/no_room_error.h"

// Of a file under a temporary name, those who live hold a shared lock, and who finds it takes an
// exclusive one before removing it. The lock lies beyond the end of the file, where no system's
// locks keep anybody from reading or writing. Between making a file and locking it, another process
// may take it for a left one: then it has no name any more, and another is made.
//
// A name is taken with renameat2(RENAME_EXCHANGE) where there is an old file and the file system
// can, so that the old file is at hand for `take_back`; otherwise with rename. Both are one step:
// no moment shows less than a whole file. Calls that a signal interrupted are made again.

namespace sphparam {
namespace {

namespace fs = std::filesystem;

/// The names of temporaries, where a signal handler can read them. What finds no place is left for
/// the next run to clean up.
constexpr std::size_t most_watched = 64;
std::array<std::atomic<const char*>, most_watched> watched{};

void watch(const char* path) {
  for (std::atomic<const char*>& place : watched) {
    const char* nobody = nullptr;
    if (place.compare_exchange_strong(nobody, path)) return;
  }
}

void forget(const char* path) {
  for (std::atomic<const char*>& place : watched) {
    const char* known = path;
    if (place.compare_exchange_strong(known, nullptr)) return;
  }
}

bool is_want_of_room(int error) {
  return error == ENOSPC || error == EDQUOT || error == EFBIG || error == EROFS || error == EIO;
}

[[noreturn]] void fail(const std::string& path, const std::string& doing) {
  const int error = errno;
  const std::string message = doing + ": " + std::strerror(error);
  if (is_want_of_room(error)) throw NoRoomError(path, message);
  throw WriteError(path, message);
}

/// The call, made again for as long as signals interrupt it.
template <class Call>
auto uninterrupted(Call call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

/// A descriptor that is closed on every way out; `close` says whether that went well.
class OutputDescriptor {
 public:
  explicit OutputDescriptor(int number) : number_(number) {}
  ~OutputDescriptor() { close(); }
  OutputDescriptor(const OutputDescriptor&) = delete;
  OutputDescriptor& operator=(const OutputDescriptor&) = delete;

  int number() const { return number_; }
  /// An interrupted close has closed, on Linux: it must not be made again.
  bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0 || errno == EINTR;
  }

 private:
  int number_;
};

constexpr std::string_view prefix = ".sphparam-", suffix = ".tmp";
constexpr std::size_t random_digit_count = 16, check_digit_count = 8;

std::string hex_digits(std::uint64_t number, std::size_t count) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text(count, '0');
  for (std::size_t i = count; i-- > 0; number >>= 4) text[i] = digits[number & 15];
  return text;
}

/// What must follow the random digits (FNV-1a, begun with the prefix).
std::string check_digits(std::string_view digits) {
  std::uint32_t hash = 2166136261U;
  for (const std::string_view part : {prefix, digits})
    for (const char c : part) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hex_digits(hash, check_digit_count);
}

std::string new_name() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != sizeof number) {
    std::random_device device;
    number = (std::uint64_t{device()} << 32) ^ device();
  }
  const std::string digits = hex_digits(number, random_digit_count);
  return std::string(prefix) + digits + check_digits(digits) + std::string(suffix);
}

bool is_our_name(std::string_view name) {
  if (name.size() != prefix.size() + random_digit_count + check_digit_count + suffix.size())
    return false;
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return false;
  const std::string_view digits = name.substr(prefix.size(), random_digit_count);
  return name.substr(prefix.size() + random_digit_count, check_digit_count) == check_digits(digits);
}

/// Locks an open file, shared (F_RDLCK) or exclusively (F_WRLCK), until its descriptor is closed.
bool lock(int descriptor, short kind, bool wait) {
  struct flock range {};
  range.l_type = kind;
  range.l_whence = SEEK_SET;
  range.l_start = off_t{1} << 62;
  range.l_len = 1;
  return uninterrupted(
             [&] { return ::fcntl(descriptor, wait ? F_OFD_SETLKW : F_OFD_SETLK, &range); }) == 0;
}

void remove_left(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (!is_our_name(entry->path().filename().string())) continue;
    constexpr int as_it_is = O_WRONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC;
    const OutputDescriptor file(
        uninterrupted([&] { return ::open(entry->path().c_str(), as_it_is); }));
    if (file.number() >= 0 && lock(file.number(), F_WRLCK, false)) ::unlink(entry->path().c_str());
  }
}

std::mutex waiting_mutex;

/// How many files of this process wait in which folder.
std::map<fs::path, int>& waiting() {
  static std::map<fs::path, int> counts;
  return counts;
}

bool has_a_name(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

}  // namespace

TemporaryFile::Waiting::Waiting(const fs::path& folder) : folder_(folder) {
  const std::lock_guard lock(waiting_mutex);
  if (waiting()[folder_]++ == 0) remove_left(folder_);
}

TemporaryFile::Waiting::~Waiting() {
  const std::lock_guard lock(waiting_mutex);
  const auto place = waiting().find(folder_);
  if (--place->second == 0) waiting().erase(place);
}

TemporaryFile::TemporaryFile(fs::path target, const struct stat* replaced)
    : target_(std::move(target)), spelling_(one_spelling(target_)), waiting_(folder_of(target_)) {
  require_folder(target_);
  constexpr mode_t usual = 0666, ours = 0600;
  try {
    open(replaced ? ours : usual);
    if (replaced) hand_on(target_.string(), *replaced, held_);
  } catch (...) {
    if (descriptor_ >= 0) ::unlink(path_.c_str());
    close();
    throw;
  }
}

TemporaryFile::TemporaryFile(fs::path target, std::string_view bytes, const struct stat* replaced)
    : TemporaryFile(std::move(target), replaced) {
  write_all(descriptor_, bytes, target_.string());
  sync();
}

TemporaryFile::~TemporaryFile() {
  if (place_ == Place::Temporary || place_ == Place::Exchanged) ::unlink(path_.c_str());
  close();
}

void TemporaryFile::close() noexcept {
  forget(path_.c_str());
  for (const int descriptor : {descriptor_, held_, old_})
    if (descriptor >= 0) ::close(descriptor);
}

void TemporaryFile::open(mode_t permissions) {
  constexpr int new_file_flags = O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC;
  do {
    forget(path_.c_str());
    if (descriptor_ >= 0) ::close(descriptor_);
    path_ = (folder_of(target_) / new_name()).string();
    watch(path_.c_str());
    descriptor_ = uninterrupted([&] { return ::open(path_.c_str(), new_file_flags, permissions); });
    if (descriptor_ < 0) fail(target_.string(), "cannot make a file in its folder");
    lock(descriptor_, F_RDLCK, true);
  } while (!has_a_name(descriptor_));
  held_ = ::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (held_ < 0) fail(target_.string(), "cannot make a file in its folder");
}

void TemporaryFile::write_at(std::int64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::pwrite(descriptor_, bytes.data(), bytes.size(), offset); });
    if (count == 0) errno = ENOSPC;
    if (count <= 0) fail(target_.string(), "cannot write");
    bytes.remove_prefix(static_cast<std::size_t>(count));
    offset += count;
  }
}

std::size_t TemporaryFile::read_at(std::int64_t offset, char* bytes, std::size_t size) const {
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t count = uninterrupted([&] {
      return ::pread(held_, bytes + filled, size - filled,
                     offset + static_cast<std::int64_t>(filled));
    });
    if (count < 0) fail(target_.string(), "cannot be read back");
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  return filled;
}

void TemporaryFile::sync() {
  if (descriptor_ < 0) return;
  if (uninterrupted([&] { return ::fsync(descriptor_); }) != 0)
    fail(target_.string(), "cannot write to disk");
  OutputDescriptor output(std::exchange(descriptor_, -1));
  if (!output.close()) fail(target_.string(), "cannot write");
}

void TemporaryFile::publish() {
  constexpr int as_it_is = O_RDONLY | O_NONBLOCK | O_CLOEXEC;
  old_ = uninterrupted([&] { return ::open(target_.c_str(), as_it_is); });
  if (old_ >= 0) lock(old_, F_RDLCK, false);
  if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
    place_ = Place::Exchanged;
    return;
  }
  const bool was_free = errno == ENOENT;
  if (::rename(path_.c_str(), target_.c_str()) != 0) fail(target_.string(), "cannot rename");
  place_ = was_free ? Place::Published : Place::Replaced;
}

void TemporaryFile::take_back() noexcept {
  if (place_ == Place::Temporary || place_ == Place::Replaced) return;
  const unsigned how = place_ == Place::Exchanged ? RENAME_EXCHANGE : 0;
  if (::renameat2(AT_FDCWD, target_.c_str(), AT_FDCWD, path_.c_str(), how) == 0)
    place_ = Place::Temporary;
}

void remove_temporaries_on_signal() noexcept {
  for (std::atomic<const char*>& place : watched)
    if (const char* const path = place.exchange(nullptr)) ::unlink(path);
}

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::write(descriptor, bytes.data(), bytes.size()); });
    if (count == 0) errno = ENOSPC;
    if (count <= 0) fail(path, "cannot write");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void write_directly(const std::string& path, std::string_view bytes) {
  OutputDescriptor output(
      uninterrupted([&] { return ::open(path.c_str(), O_WRONLY | O_CLOEXEC); }));
  if (output.number() < 0) fail(path, "cannot open for writing");
  write_all(output.number(), bytes, path);
  if (!output.close()) fail(path, "cannot write");
}

void sync_folder(const fs::path& folder, const std::string& path) {
  const OutputDescriptor directory(
      uninterrupted([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }));
  if (directory.number() < 0) return;  // a folder one may write to but not list
  // Some file systems cannot sync a folder and say EINVAL.
  if (uninterrupted([&] { return ::fsync(directory.number()); }) != 0 && errno != EINVAL)
    fail(path, "cannot write to disk");
}

std::string one_spelling(const fs::path& file) {
  std::error_code hidden;  // relative names that are not there yet would stay relative
  return fs::weakly_canonical(fs::absolute(file, hidden), hidden).string();
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void require_folder(const fs::path& file) {
  std::error_code hidden;
  const fs::path folder = folder_of(file);
  if (!fs::is_directory(folder, hidden))
    throw WriteError(file.string(), "the folder " + folder.string() + " does not exist");
}

}  // namespace sphparam
