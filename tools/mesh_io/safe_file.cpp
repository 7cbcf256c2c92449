#include "mesh_io/safe_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "mesh_io/file_bytes.h"
#include "mesh_io/temporary_file.h"

// Everything that can fail for long (space, disk, the check) happens while the files still have
// temporary names. What is left are renames, each of which can be taken back.

namespace sphparam::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as many as Linux follows

/// The file that a path names, through links; the last one may name nothing yet.
fs::path followed(fs::path path) {
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(path, error)); ++links) {
    const fs::path next = fs::read_symlink(path, error);
    if (links == kMostLinks) error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
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
  }
  return {target, status};
}

/// A temporary with these bytes, or, without any, one to be written.
std::unique_ptr<TemporaryFile> make_temporary(const std::string& path,
                                              std::optional<std::string_view> bytes) {
  const auto make = [&](const fs::path& target, std::optional<mode_t> permissions) {
    return bytes ? std::make_unique<TemporaryFile>(target, *bytes, permissions)
                 : std::make_unique<TemporaryFile>(target, permissions);
  };
  const Place place = writable_place(path);
  if (!place.status) return make(place.target, std::nullopt);
  return make(place.target, place.status->st_mode & 07777);
}

void check_on_disk(const TemporaryFile& file, std::size_t size, const BytesCheck& check) {
  const FileBytes on_disk(file.path(), std::numeric_limits<std::uint64_t>::max());
  if (on_disk.view().size() != size)
    throw WriteError(file.target().string(),
                     "the disk holds another number of bytes than were written");
  check(on_disk.view());
}

}  // namespace

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
  if (is_pending(path)) throw WriteError(path, "two outputs go to this file");
  auto file = make_temporary(path, bytes);
  if (check) check_on_disk(*file, bytes.size(), check);
  files_.push_back(std::move(file));
}

PendingFiles::WriteAt PendingFiles::open(const std::string& path) {
  if (is_stream(path)) {
    Stream* stream = streams_.emplace_back(std::make_unique<Stream>(Stream{path, {}})).get();
    return [stream](std::int64_t offset, std::string_view bytes) {
      const auto at = static_cast<std::size_t>(offset);
      if (stream->bytes.size() < at + bytes.size()) stream->bytes.resize(at + bytes.size());
      bytes.copy(stream->bytes.data() + at, bytes.size());
    };
  }
  if (is_pending(path)) throw WriteError(path, "two outputs go to this file");
  TemporaryFile* file = files_.emplace_back(make_temporary(path, std::nullopt)).get();
  return [file](std::int64_t offset, std::string_view bytes) { file->write_at(offset, bytes); };
}

bool PendingFiles::is_pending(const std::string& path) const {
  const auto one_spelling = [](const fs::path& file) {
    std::error_code hidden;  // relative names that are not there yet would stay relative
    return fs::weakly_canonical(fs::absolute(file, hidden), hidden);
  };
  const fs::path wanted = one_spelling(followed(path));
  return std::any_of(files_.begin(), files_.end(),
                     [&](const auto& file) { return one_spelling(file->target()) == wanted; });
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

}  // namespace sphparam::tools
