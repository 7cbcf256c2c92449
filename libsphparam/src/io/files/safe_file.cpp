#include "sphparam/io/safe_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "io/files/file_bytes.h"
#include "io/files/temporary_file.h"

// Everything that can fail for long (space, disk, the check) happens while the files still have
// temporary names. What is left are renames, each of which can be taken back.

namespace sphparam {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // as many as Linux follows

/// The file that a path names, through links; the last one may name nothing yet.
fs::path followed(fs::path path) {
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(path, error)); ++links) {
    const fs::path next = fs::read_symlink(path, error);
    if (links == most_links) error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    if (error) throw WriteError(path.string(), error.message());
    path = folder_of(path) / next;
  }
  return path;
}

/// What a path holds now; nothing if it is free.
std::optional<struct stat> status_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return status;
  if (errno == ENOENT) return std::nullopt;
  throw WriteError(path.string(), std::strerror(errno));
}

bool is_stream(const std::string& path) {
  if (path == "-") return true;
  const std::optional<struct stat> status = status_of(path);
  return status && !S_ISREG(status->st_mode) && !S_ISDIR(status->st_mode);
}

/// Device and number of the files that no output may replace.
std::vector<std::pair<dev_t, ino_t>>& kept_files() {
  static std::vector<std::pair<dev_t, ino_t>> files;
  return files;
}

std::mutex& kept_files_mutex() {
  static std::mutex mutex;
  return mutex;
}

bool is_kept(const struct stat& status) {
  const std::lock_guard lock(kept_files_mutex());
  return std::ranges::count(kept_files(), std::pair(status.st_dev, status.st_ino)) > 0;
}

/// What a path names, through links.
struct Place {
  fs::path target;
  std::optional<struct stat> status;  // nothing: it is free
};

Place writable_place(const std::string& path) {
  if (path.empty()) throw WriteError("''", "the name of the file is empty");
  const fs::path target = followed(path);
  const std::optional<struct stat> status = status_of(target);
  if (!status) {
    require_folder(target);
  } else if (S_ISDIR(status->st_mode)) {
    throw WriteError(path, "is a directory");
  } else if (::access(target.c_str(), W_OK) != 0) {
    throw WriteError(path, std::string("cannot be written: ") + std::strerror(errno));
  } else if (is_kept(*status)) {
    throw WriteError(path, "is read by this command; it would be replaced");
  }
  return {target, status};
}

/// A temporary with these bytes, or, without any, one to be written.
std::unique_ptr<TemporaryFile> make_temporary(const std::string& path,
                                              std::optional<std::string_view> bytes) {
  const Place place = writable_place(path);
  const struct stat* const replaced = place.status ? &*place.status : nullptr;
  return bytes ? std::make_unique<TemporaryFile>(place.target, *bytes, replaced)
               : std::make_unique<TemporaryFile>(place.target, replaced);
}

/// Compares what is on the disk with what was written, which need not be held any longer then.
void check_on_disk(const TemporaryFile& file, std::string bytes, const BytesCheck& check) {
  const std::string name = file.target().string();
  try {
    const FileBytes on_disk(file.descriptor(), name);
    if (on_disk.view() != bytes)
      throw WriteError(name, "the disk holds other bytes than were written");
    std::string().swap(bytes);
    if (check) check(on_disk.view());
  } catch (const ReadError& error) {  // of what we wrote: it is no input that is at fault
    throw WriteError(name, std::string("what was written cannot be read back: ") + error.what());
  }
}

}  // namespace

void keep_from_outputs(const std::vector<std::string>& paths) {
  const std::lock_guard lock(kept_files_mutex());
  for (const std::string& path : paths) {
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) kept_files().emplace_back(status.st_dev, status.st_ino);
  }
}

void require_writable(const std::string& path) {
  if (!is_stream(path)) writable_place(path);
}

PendingFiles::PendingFiles() = default;
PendingFiles::~PendingFiles() = default;

void PendingFiles::add(const std::string& path, std::string bytes, const BytesCheck& check) {
  if (is_stream(path)) {
    if (check) check(bytes);
    streams_.push_back(std::make_unique<Stream>(Stream{path, std::move(bytes)}));
    return;
  }
  if (pending(path)) throw WriteError(path, "two outputs go to this file");
  auto file = make_temporary(path, bytes);
  check_on_disk(*file, std::move(bytes), check);
  files_.push_back(std::move(file));
}

PendingFiles::Pieces PendingFiles::open(const std::string& path) {
  if (is_stream(path)) {
    Stream* stream = streams_.emplace_back(std::make_unique<Stream>(Stream{path, {}})).get();
    return {[stream](std::int64_t offset, std::string_view bytes) {
              const auto at = static_cast<std::size_t>(offset);
              if (stream->bytes.size() < at + bytes.size()) stream->bytes.resize(at + bytes.size());
              bytes.copy(stream->bytes.data() + at, bytes.size());
            },
            [stream](std::int64_t offset, char* bytes, std::size_t size) {
              const auto at = static_cast<std::size_t>(offset);
              return at < stream->bytes.size() ? stream->bytes.copy(bytes, size, at) : 0;
            }};
  }
  if (pending(path)) throw WriteError(path, "two outputs go to this file");
  TemporaryFile* file = files_.emplace_back(make_temporary(path, std::nullopt)).get();
  return {[file](std::int64_t offset, std::string_view bytes) { file->write_at(offset, bytes); },
          [file](std::int64_t offset, char* bytes, std::size_t size) {
            return file->read_at(offset, bytes, size);
          }};
}

const TemporaryFile* PendingFiles::pending(const std::string& path) const {
  const std::string wanted = one_spelling(followed(path));
  const auto found =
      std::ranges::find_if(files_, [&](const auto& file) { return file->spelling() == wanted; });
  return found == files_.end() ? nullptr : found->get();
}

std::string PendingFiles::place_of(const std::string& path) const {
  const TemporaryFile* const file = is_stream(path) ? nullptr : pending(path);
  return file ? file->place() : "";
}

void PendingFiles::publish() {
  for (const auto& file : files_) file->sync();
  for (const auto& stream : streams_)
    stream->path == "-" ? write_all(STDOUT_FILENO, stream->bytes, "standard output")
                        : write_directly(stream->path, stream->bytes);
  try {
    std::set<fs::path> folders;
    for (const auto& file : files_) {
      file->publish();
      folders.insert(folder_of(file->target()));
    }
    for (const fs::path& folder : folders) sync_folder(folder, folder.string());
  } catch (...) {
    for (const auto& file : files_) file->take_back();
    throw;
  }
  streams_.clear();
  files_.clear();
}

void write_file(const std::string& path, std::string bytes, const BytesCheck& check) {
  PendingFiles one;
  one.add(path, std::move(bytes), check);
  one.publish();
}

}  // namespace sphparam
