#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/read_options.h"
#include "sphparam/io/scalar_type.h"

namespace sphparam {

enum class PlyEncoding { Ascii, BinaryLittleEndian, BinaryBigEndian };

/// The list of a face's corners goes by either name.
inline bool is_corner_list_name(std::string_view name) {
  return name == "vertex_indices" || name == "vertex_index";
}

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::Float64;  // of the value, or of the entries of a list
  bool is_list = false;
  ScalarType count_type = ScalarType::Uint8;  // of a list
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
  long line = 0;  // where the header declares it

  const PlyProperty* find(std::string_view property_name) const;
  /// Fewest bytes a record can have: the corners of a face are at least three, other lists empty.
  std::uint64_t least_bytes(PlyEncoding encoding) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  // and obj_info lines, without the keyword
  long infos = 0;                     // how many of them are obj_info lines
  std::size_t body_offset = 0;        // bytes
  long body_line = 1;                 // number of the first line of the body

  const PlyElement* find(std::string_view element_name) const;
};

/// Reads the header of a PLY file, lines ending in LF, CRLF or CR (as the first one does). Before a
/// binary body CR alone is refused: a body that starts with the byte of LF would look like CRLF.
/// Ensures: the elements, each record as small as it can be, fit the bytes that follow.
/// Throws: ReadError with the line.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& name,
                           const ReadOptions& options);

}  // namespace sphparam
