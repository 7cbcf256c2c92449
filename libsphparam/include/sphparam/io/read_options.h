#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sphparam {

/// Limits of what is read, and what is left out. A file beyond a limit is refused before memory is
/// spent on it.
struct ReadOptions {
  /// Of a PLY only positions, faces and sx sy sz: for who wants to prove a written map again.
  bool only_map = false;
  /// Faces that name a vertex twice are let through: a vertex named twice in a row counts once, and
  /// what repeats one even so is one triangle that does, for a repair to remove. Else refused.
  bool repeated_corners = false;
  /// Coordinates that are no finite numbers are let through, as NaN, for a repair to drop them with
  /// their faces. Else refused.
  bool non_finite = false;
  std::uint64_t max_file_bytes = std::uint64_t{1} << 31;
  std::int64_t max_vertices = std::int64_t{1} << 28;
  std::int64_t max_faces = std::int64_t{1} << 28;  // of the file, and of triangles
  std::int64_t max_polygon_degree = 1 << 16;       // corners of one face
  std::int64_t max_line_bytes = 1 << 20;           // of a text file or a header
  std::int64_t max_ply_elements = 64;
  std::int64_t max_ply_properties = 256;   // of one element
  std::int64_t max_json_bytes = 64 << 20;  // of a glTF file
  std::int64_t max_json_depth = 64;
  std::int64_t max_json_values = 1 << 20;
  std::int64_t max_json_objects = 1 << 17;
};

/// A file that cannot be read, with the place: "mesh.obj:12: face names vertex 9 of 8" in text,
/// "mesh.ply: byte 812: …" in binary data. The program ends with exit code 3.
class ReadError : public std::runtime_error {
 public:
  /// The file as a whole cannot be used.
  ReadError(const std::string& file, const std::string& message);
  static ReadError at_line(const std::string& file, long line, const std::string& message);
  static ReadError at_byte(const std::string& file, std::uint64_t byte, const std::string& message);

  long line() const { return line_; }           // 1-based; 0 when not known
  std::uint64_t byte() const { return byte_; }  // offset in the file, for binary data

 private:
  explicit ReadError(const std::string& what) : std::runtime_error(what) {}
  long line_ = 0;
  std::uint64_t byte_ = 0;
};

/// What the refusal of a face that names a vertex twice ends with: the way out.
std::string repeated_corners_advice();

/// What is said of a file, or of what it unpacks to, of more than `max_bytes`, with the way out:
/// "the limit of 4096 bytes; `--limit file=N` raises it".
std::string file_limit(std::uint64_t max_bytes);

/// Text of a hostile file as it may be shown: printable, at most 40 characters, in quotes.
std::string quoted(std::string_view text);

}  // namespace sphparam
