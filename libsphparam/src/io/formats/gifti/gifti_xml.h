#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/read_options.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// One array of a GIFTI file: its attributes as written, its data still encoded.
struct GiftiArray {
  struct CoordinateSystem {
    std::string data_space, transformed_space, matrix;
  };

  long line = 0;       // of <DataArray>
  long data_line = 0;  // of <Data>
  std::string intent, data_type, encoding, endian, order, external_file;
  std::vector<std::int64_t> dimensions;
  Metadata metadata;
  std::vector<CoordinateSystem> coordinate_systems;
  std::string data;
};

struct GiftiDocument {
  Metadata metadata;
  std::vector<GiftiArray> arrays;
  std::vector<Label> labels;
};

/// Takes the XML of a GIFTI file apart. Attributes and nesting are checked, the data is not
/// decoded. Refused: malformed XML, entity declarations, nesting deeper than GIFTI has, missing or
/// repeated elements, a number of arrays other than the one announced. Throws: ReadError with the
/// line.
GiftiDocument parse_gifti_xml(std::string_view bytes, const std::string& name);

/// "array of 'NIFTI_INTENT_TRIANGLE' …", at its line.
[[noreturn]] void fail_in_array(const std::string& name, const GiftiArray& array,
                                const std::string& message);

}  // namespace sphparam
