#include "mesh_io/safe_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "mesh_io/file_bytes.h"

namespace sphparam::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& doing) {
  throw WriteError(path, doing + ": " + std::strerror(errno));
}

/// A descriptor that is closed on every way out; `close` says whether that went well.
class OutputDescriptor {
 public:
  explicit OutputDescriptor(int number) : number_(number) {}
  ~OutputDescriptor() { close(); }
  OutputDescriptor(const OutputDescriptor&) = delete;
  OutputDescriptor& operator=(const OutputDescriptor&) = delete;

  int number() const { return number_; }
  bool close() {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "cannot write");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void write_directly(const std::string& path, std::string_view bytes) {
  OutputDescriptor output(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (output.number() < 0) fail(path, "cannot open for writing");
  write_all(output.number(), bytes, path);
  if (!output.close()) fail(path, "cannot write");
}

/// The temporary of one write: made new, removed unless it became the file.
class Temporary {
 public:
  explicit Temporary(const fs::path& target)
      : target_(target), path_(target.string() + ".tmp." + std::to_string(::getpid())) {}
  ~Temporary() {
    if (made_) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void fill(std::string_view bytes, std::optional<mode_t> permissions) {
    constexpr mode_t kUsual = 0666;
    OutputDescriptor output(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kUsual));
    if (output.number() < 0) fail(target_.string(), "cannot make a file in its folder");
    made_ = true;
    if (permissions) static_cast<void>(::fchmod(output.number(), *permissions));
    write_all(output.number(), bytes, target_.string());
    if (::fsync(output.number()) != 0) fail(target_.string(), "cannot write to disk");
    if (!output.close()) fail(target_.string(), "cannot write");
  }

  void check(std::string_view bytes, const BytesCheck& check) const {
    const FileBytes on_disk(path_, std::numeric_limits<std::uint64_t>::max());
    if (on_disk.view().size() != bytes.size())
      throw WriteError(target_.string(),
                       "the disk holds another number of bytes than were written");
    check(on_disk.view());
  }

  void become_the_file() {
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail(target_.string(), "cannot rename");
    made_ = false;
  }

 private:
  fs::path target_;
  std::string path_;
  bool made_ = false;
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

void remove_stale_temporaries(const fs::path& target, const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::optional<pid_t> maker = maker_of(entry->path().filename().string(), target);
    if (!maker) continue;
    const bool gone = *maker == ::getpid() || (::kill(*maker, 0) != 0 && errno == ESRCH);
    if (gone) ::unlink(entry->path().c_str());
  }
}

void sync_folder(const fs::path& folder, const std::string& path) {
  const OutputDescriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.number() < 0) return;  // a folder one may write to but not list
  // Some file systems cannot sync a folder and say EINVAL.
  if (::fsync(directory.number()) != 0 && errno != EINVAL) fail(path, "cannot write to disk");
}

void replace_file(const fs::path& target, std::string_view bytes, std::optional<mode_t> permissions,
                  const BytesCheck& check) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code hidden;
  if (!fs::is_directory(folder, hidden))
    throw WriteError(target.string(), "the folder " + folder.string() + " does not exist");
  remove_stale_temporaries(target, folder);
  Temporary temporary(target);
  temporary.fill(bytes, permissions);
  if (check) temporary.check(bytes, check);
  temporary.become_the_file();
  sync_folder(folder, target.string());
}

}  // namespace

void write_file(const std::string& path, std::string_view bytes, const BytesCheck& check) {
  if (path == "-") {
    if (check) check(bytes);
    return write_all(STDOUT_FILENO, bytes, "standard output");
  }
  if (path.empty()) throw WriteError("''", "the name of the file is empty");

  std::error_code missing;
  const fs::path resolved = fs::canonical(path, missing);
  if (missing) return replace_file(path, bytes, std::nullopt, check);

  struct stat status {};
  if (::stat(resolved.c_str(), &status) != 0) fail(path, "cannot inspect");
  if (S_ISDIR(status.st_mode)) throw WriteError(path, "is a directory");
  if (::access(resolved.c_str(), W_OK) != 0) fail(path, "cannot be written");
  if (S_ISREG(status.st_mode)) return replace_file(resolved, bytes, status.st_mode & 07777, check);
  if (check) check(bytes);
  write_directly(path, bytes);
}

}  // namespace sphparam::tools
