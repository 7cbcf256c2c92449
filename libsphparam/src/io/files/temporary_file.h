#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace sphparam {

/// A new file in the folder of its target, under a name that nobody else makes, until it takes the
/// target's name. Whatever has the temporary name is removed at the end, also by
/// `remove_temporaries_on_signal`.
///
/// The name is ".sphparam-" with sixteen digits that cannot be guessed and eight that follow from
/// them, whatever the target is called. While the process lives it holds a lock on the open file,
/// which ends with the process, however that ends. So a file that has such a name and no lock was
/// left by a process that is no more, in whatever container it ran: only such files are removed.
/// Where a file system has no locks, none are; where locks do not reach other machines that write
/// to the same folder, theirs look left.
class TemporaryFile {
 public:
  /// Writes `bytes` to the disk (fsync). Removes what processes left in that folder which are no
  /// more, unless others of this process wait there, who did. `replaced`: the file that has the
  /// target's name; the new one gets its permissions, and as far as the user may give them, its
  /// owner, group, ACL and attributes user.*. Throws: WriteError that names the target.
  TemporaryFile(std::filesystem::path target, std::string_view bytes, const struct stat* replaced);
  /// The same without bytes: they come by `write_at`, until `sync`.
  TemporaryFile(std::filesystem::path target, const struct stat* replaced);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& target() const { return target_; }
  /// The same from the root, its folders without links, however it was named.
  const std::string& spelling() const { return spelling_; }
  /// Where the bytes are until then.
  const std::string& place() const { return path_; }
  /// Reads the file, whatever its permissions and its name.
  int descriptor() const { return held_; }

  /// Writes bytes at a place of the file, which may be before or beyond its end.
  /// Requires: not synced yet. Throws: WriteError.
  void write_at(std::int64_t offset, std::string_view bytes);
  /// Reads what is there from a place on, up to `size` bytes; returns how many. Throws: WriteError.
  std::size_t read_at(std::int64_t offset, char* bytes, std::size_t size) const;
  /// Brings what was written to the disk (fsync), once. Throws: WriteError.
  void sync();

  /// Takes the target's name in one step; a file that had it keeps existing under the temporary
  /// name, where the file system can exchange names.
  /// Throws: WriteError; then nothing happened.
  void publish();

  /// Undoes `publish` as far as the file system allows.
  void take_back() noexcept;

 private:
  void open(mode_t permissions);
  void close() noexcept;

  enum class Place {
    Temporary,
    Published,  // where no file was
    Exchanged,  // the old file has the temporary name
    Replaced,   // the old file is gone
  };

  /// One who waits in a folder.
  class Waiting {
   public:
    explicit Waiting(const std::filesystem::path& folder);
    ~Waiting();
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

   private:
    std::filesystem::path folder_;
  };

  std::filesystem::path target_;
  std::string spelling_;
  Waiting waiting_;
  std::string path_;
  int descriptor_ = -1;  // until `sync`
  int held_ = -1;        // the same open file, with its lock
  int old_ = -1;         // the file that was replaced, with a lock of ours
  Place place_ = Place::Temporary;
};

/// Removes the temporaries that are there now. Async-signal-safe; for a handler that ends the
/// process.
void remove_temporaries_on_signal() noexcept;

/// Writes all bytes to a descriptor. `path` stands in messages. Throws: WriteError.
void write_all(int descriptor, std::string_view bytes, const std::string& path);

/// Writes the bytes to what is there, without a temporary: a device or a pipe. Throws: WriteError.
void write_directly(const std::string& path, std::string_view bytes);

/// Makes the names of a folder survive a power cut. Throws: WriteError that names `path`.
void sync_folder(const std::filesystem::path& folder, const std::string& path);

/// A file from the root, its folders without links.
std::string one_spelling(const std::filesystem::path& file);

/// The folder of a file, "." where none is named.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Throws: WriteError when that folder is not there.
void require_folder(const std::filesystem::path& file);

}  // namespace sphparam
