#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sphparam::tools {

/// A file that cannot be written, with its path and the reason. The program ends with exit code 3.
class WriteError : public std::runtime_error {
 public:
  WriteError(const std::string& path, const std::string& message)
      : std::runtime_error(path + ": " + message) {}
};

/// Judges the bytes that are about to become the file; throws to keep them from it.
using BytesCheck = std::function<void(std::string_view bytes)>;

/// Writes a file so that its name holds the old bytes or all of the new ones, whatever happens:
/// temporary in the same folder, fsync, `check` on the bytes read back from disk, rename, fsync of
/// the folder. The temporary is removed on any failure; those of processes that were killed are
/// removed by the next write to the same name. A link is followed, permissions are kept.
///
/// Path "-" is standard output; there, and where the path is a device or a pipe, `check` judges the
/// buffer itself before its first byte is written.
/// Throws: WriteError; whatever `check` throws.
void write_file(const std::string& path, std::string_view bytes, const BytesCheck& check = {});

}  // namespace sphparam::tools
