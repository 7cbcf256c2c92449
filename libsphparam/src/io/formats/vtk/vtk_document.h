#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/vtk/vtk_surface.h"

namespace sphparam {

/// Where the numbers of an array of an XML file are.
enum class VtkEncoding { Ascii, Binary, Appended };

/// One array of an XML file: what its start tag says, its text still encoded.
struct VtkXmlArray {
  long line = 0;
  std::string name, type;  // "Float64"; "String"
  std::int64_t width = 1;
  VtkEncoding encoding = VtkEncoding::Ascii;
  std::uint64_t offset = 0;  // in the appended data
  std::string text;
  std::vector<std::string> component_names;
};

/// Arrays of points or cells, and which of them the file calls normals and texture coordinates.
struct VtkXmlData {
  std::string normals, texcoords;
  std::vector<VtkXmlArray> arrays;
};

/// Part of a polydata with points of its own.
struct VtkXmlPiece {
  std::int64_t points = 0, verts = 0, lines = 0, strips = 0, polys = 0;
  std::optional<VtkXmlArray> coordinates;
  struct Cells {
    std::optional<VtkXmlArray> connectivity, offsets;
  };
  Cells strip_cells, poly_cells;
  VtkXmlData point_data, cell_data;
};

struct VtkDocument {
  std::endian order = std::endian::little;
  bool wide_headers = false;  // in front of data: of 64 bits, else of 32
  bool compressed = false;    // by zlib
  std::vector<VtkXmlPiece> pieces;
  std::vector<VtkXmlArray> field_data;
  std::string_view appended;  // what follows the underscore
  bool appended_is_base64 = false;
};

/// Takes the XML of a polydata apart; no data is decoded. `bytes` must outlive the document.
/// Refused by name: other kinds of data, other compressors. Throws: ReadError with the line.
VtkDocument parse_vtk_document(std::string_view bytes, const std::string& name);

/// Decodes arrays of a document. Arrays may share bytes and unpack to a thousand times these: what
/// one file may make us decode is bounded by a multiple of its bytes.
class VtkDecoder {
 public:
  /// Requires: all three outlive the decoder. `file_bytes`: size of the whole file.
  VtkDecoder(const VtkDocument& document, std::size_t file_bytes, const std::string& name);

  /// The numbers of an array: as many as `count` says, or as there are where it is −1. Whole
  /// numbers of 64 bits that had to be rounded are told among `notes`.
  /// Throws: ReadError at the array's line.
  VtkArray numbers(const VtkXmlArray& array, std::int64_t count, std::vector<std::string>& notes,
                   TextDigits digits = TextDigits::AsDeclared);

  /// The strings of an array of type String.
  std::vector<std::string> strings(const VtkXmlArray& array);

 private:
  const VtkDocument& document_;
  const std::string& name_;
  std::uint64_t numbers_left_;
};

[[noreturn]] void fail_in_array(const std::string& name, const VtkXmlArray& array,
                                const std::string& message);

}  // namespace sphparam
