#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sphparam {

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
/// `add` makes a temporary in the same folder: write, fsync, and the bytes read back from disk must
/// be those that were given, and please `check`. `publish` renames them all and syncs the folders;
/// where one of these steps fails, the earlier ones are undone. Temporaries are removed on any
/// failure; those of processes that were killed are removed by the next write to the same folder
/// (`TemporaryFile` says how they are told from all others).
///
/// Symbolic links are followed, also to files that are not there yet: the link stays. A file that
/// is replaced hands on permissions, owner and more (`hand_on`); where it has other names, hard
/// links, these keep the old bytes. New files are as the umask wants them.
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

  /// A file that is written piece by piece, by the function `write`: `offset` may be before or
  /// beyond the end of what was written. For files that memory does not hold; what goes to a stream
  /// is held all the same. `read` gives back what is there, up to `size` bytes: who writes so
  /// judges so, as nobody else has the bytes. Both throw WriteError. Throws: WriteError.
  struct Pieces {
    std::function<void(std::int64_t offset, std::string_view bytes)> write;
    std::function<std::size_t(std::int64_t offset, char* bytes, std::size_t size)> read;
  };
  Pieces open(const std::string& path);

  /// Where the bytes of a file that was added are until it is published: for who reads them again.
  /// Empty: none of them goes there, or it is a stream.
  std::string place_of(const std::string& path) const;

  /// Throws: WriteError; then no file has its name.
  void publish();

 private:
  const TemporaryFile* pending(const std::string& path) const;

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

/// From now on nothing here replaces one of these files, by whatever name and link: it is a
/// WriteError. The last guard for what a program reads.
void keep_from_outputs(const std::vector<std::string>& paths);

/// Writes one file as `PendingFiles` does.
/// Throws: WriteError; whatever `check` throws.
void write_file(const std::string& path, std::string bytes, const BytesCheck& check = {});

}  // namespace sphparam
