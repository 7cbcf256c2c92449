#include "sphparam/io/read_options.h"

#include "io/files/non_finite_advice.h"

namespace sphparam {

ReadError::ReadError(const std::string& file, const std::string& message)
    : ReadError(file + ": " + message) {}

ReadError ReadError::at_line(const std::string& file, long line, const std::string& message) {
  ReadError error(file + ":" + std::to_string(line) + ": " + message);
  error.line_ = line;
  return error;
}

ReadError ReadError::at_byte(const std::string& file, std::uint64_t byte,
                             const std::string& message) {
  ReadError error(file + ": byte " + std::to_string(byte) + ": " + message);
  error.byte_ = byte;
  return error;
}

std::string repeated_corners_advice() {
  return "; `sphparam map --repair=duplicates` removes such faces";
}

std::string non_finite_advice() {
  return "; `sphparam map --repair` drops such vertices with their faces, as --repair does "
         "wherever "
         "it is taken; `sphparam wrap` and `sphparam asset` leave them out";
}

std::string file_limit(std::uint64_t max_bytes) {
  return "the limit of " + std::to_string(max_bytes) + " bytes; `--limit file=N` raises it";
}

std::string quoted(std::string_view text) {
  constexpr std::size_t most_shown = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, most_shown)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > most_shown ? "…'" : "'");
}

}  // namespace sphparam
