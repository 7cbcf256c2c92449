#include "mesh_io/temporary_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <utility>

#include "mesh_io/safe_file.h"

// A name is taken with renameat2(RENAME_EXCHANGE) where there is an old file and the file system
// can, so that the old file is at hand for `take_back`; otherwise with rename. Both are one step:
// no moment shows less than a whole file. Calls that a signal interrupted are made again.

namespace sphparam::tools {
namespace {

namespace fs = std::filesystem;

/// The names of temporaries, where a signal handler can read them. What finds no place is left for
/// the next run to clean up.
constexpr std::size_t kMostWatched = 64;
std::array<std::atomic<const char*>, kMostWatched> watched{};

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

[[noreturn]] void fail(const std::string& path, const std::string& doing) {
  throw WriteError(path, doing + ": " + std::strerror(errno));
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

/// The process that made a temporary of `target`, told by its name.
std::optional<pid_t> maker_of(const std::string& name, const fs::path& target) {
  const std::string prefix = target.filename().string() + ".tmp.";
  if (!name.starts_with(prefix)) return std::nullopt;
  pid_t pid = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, pid);
  if (error != std::errc{} || stop != end || pid <= 0) return std::nullopt;
  return pid;
}

void remove_stale_temporaries(const fs::path& target) {
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end;
       entry.increment(error)) {
    const std::optional<pid_t> maker = maker_of(entry->path().filename().string(), target);
    if (!maker) continue;
    const bool gone = *maker == ::getpid() || (::kill(*maker, 0) != 0 && errno == ESRCH);
    if (gone) ::unlink(entry->path().c_str());
  }
}

}  // namespace

TemporaryFile::TemporaryFile(fs::path target, std::optional<mode_t> permissions)
    : target_(std::move(target)), path_(target_.string() + ".tmp." + std::to_string(::getpid())) {
  require_folder(target_);
  remove_stale_temporaries(target_);
  watch(path_.c_str());
  try {
    open(permissions);
  } catch (...) {
    forget(path_.c_str());
    throw;
  }
}

TemporaryFile::TemporaryFile(fs::path target, std::string_view bytes,
                             std::optional<mode_t> permissions)
    : TemporaryFile(std::move(target), permissions) {
  write_all(descriptor_, bytes, target_.string());
  sync();
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (place_ == Place::Temporary || place_ == Place::Exchanged) ::unlink(path_.c_str());
  forget(path_.c_str());
}

void TemporaryFile::open(std::optional<mode_t> permissions) {
  constexpr mode_t kUsual = 0666;
  constexpr int kNew = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
  descriptor_ = uninterrupted([&] { return ::open(path_.c_str(), kNew, kUsual); });
  if (descriptor_ < 0) fail(target_.string(), "cannot make a file in its folder");
  if (permissions) static_cast<void>(::fchmod(descriptor_, *permissions));
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

void TemporaryFile::sync() {
  if (descriptor_ < 0) return;
  if (uninterrupted([&] { return ::fsync(descriptor_); }) != 0)
    fail(target_.string(), "cannot write to disk");
  OutputDescriptor output(std::exchange(descriptor_, -1));
  if (!output.close()) fail(target_.string(), "cannot write");
}

void TemporaryFile::publish() {
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

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void require_folder(const fs::path& file) {
  std::error_code hidden;
  const fs::path folder = folder_of(file);
  if (!fs::is_directory(folder, hidden))
    throw WriteError(file.string(), "the folder " + folder.string() + " does not exist");
}

}  // namespace sphparam::tools
