#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sphparam::tools {

class TemporaryFile;

/// A file that cannot be written, with its path and the reason. The program ends with exit code 3.
class WriteError : public std::runtime_error {
 public:
  WriteError(const std::string& path, const std::string& message)
      : std::runtime_error(path + ": " + message) {}
};

/// Judges the bytes that are about to become the file; throws to keep them from it.
using BytesCheck = std::function<void(std::string_view bytes)>;

/// The outputs of one run: all get their names, or none does. Whatever happens, a name holds the
/// old bytes or all of the new ones.
///
/// `add` makes a temporary in the same folder: write, fsync, `check` on the bytes read back from
/// disk. `publish` renames them all and syncs the folders; where one of these steps fails, the
/// earlier ones are undone. Temporaries are removed on any failure; those of processes that were
/// killed are removed by the next write to the same name. Links are followed, also to files that
/// are not there yet; permissions are kept.
///
/// Path "-" is standard output; there, and where the path is a device or a pipe, `check` judges the
/// buffer itself, and its first byte is written by `publish`, before any file gets its name.
class PendingFiles {
 public:
  PendingFiles();
  ~PendingFiles();
  PendingFiles(const PendingFiles&) = delete;
  PendingFiles& operator=(const PendingFiles&) = delete;

  /// Throws: WriteError; whatever `check` throws. The files added before stay pending.
  void add(const std::string& path, std::string bytes, const BytesCheck& check = {});

  /// A file that is written piece by piece, by the function returned: `offset` may be before or
  /// beyond the end of what was written. For files that memory does not hold; what goes to a stream
  /// is held all the same. Throws: WriteError, as the function does.
  using WriteAt = std::function<void(std::int64_t offset, std::string_view bytes)>;
  WriteAt open(const std::string& path);

  /// Throws: WriteError; then no file has its name.
  void publish();

 private:
  bool is_pending(const std::string& path) const;

  struct Stream {
    std::string path;
    std::string bytes;
  };
  std::vector<std::unique_ptr<Stream>> streams_;
  std::vector<std::unique_ptr<TemporaryFile>> files_;
};

/// Throws the WriteError that writing to this path would begin with, where that can be told before:
/// no folder, a folder's name, no permission. Nothing is touched.
void require_writable(const std::string& path);

/// Writes one file as `PendingFiles` does.
/// Throws: WriteError; whatever `check` throws.
void write_file(const std::string& path, std::string bytes, const BytesCheck& check = {});

}  // namespace sphparam::tools
