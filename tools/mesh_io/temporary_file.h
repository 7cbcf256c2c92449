#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sphparam::tools {

/// A new file beside its target, as `TARGET.tmp.PID`, until it takes the target's name. Whatever
/// has the temporary name is removed at the end, also by `remove_temporaries_on_signal`.
class TemporaryFile {
 public:
  /// Writes `bytes` to the disk (fsync). Removes temporaries of the same target that processes left
  /// which are no more. `permissions`: those of the file that is to be replaced.
  /// Throws: WriteError that names the target.
  TemporaryFile(std::filesystem::path target, std::string_view bytes,
                std::optional<mode_t> permissions);
  /// The same without bytes: they come by `write_at`, until `sync`.
  TemporaryFile(std::filesystem::path target, std::optional<mode_t> permissions);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& target() const { return target_; }
  const std::string& path() const { return path_; }

  /// Writes bytes at a place of the file, which may be before or beyond its end.
  /// Requires: not synced yet. Throws: WriteError.
  void write_at(std::int64_t offset, std::string_view bytes);
  /// Brings what was written to the disk (fsync), once. Throws: WriteError.
  void sync();

  /// Takes the target's name in one step; a file that had it keeps existing under the temporary
  /// name, where the file system can exchange names.
  /// Throws: WriteError; then nothing happened.
  void publish();

  /// Undoes `publish` as far as the file system allows.
  void take_back() noexcept;

 private:
  void open(std::optional<mode_t> permissions);

  enum class Place {
    Temporary,
    Published,  // where no file was
    Exchanged,  // the old file has the temporary name
    Replaced,   // the old file is gone
  };

  std::filesystem::path target_;
  std::string path_;
  int descriptor_ = -1;  // until `sync`
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

/// The folder of a file, "." where none is named.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Throws: WriteError when that folder is not there.
void require_folder(const std::filesystem::path& file);

}  // namespace sphparam::tools
