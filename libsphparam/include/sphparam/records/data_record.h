#pragma once

#include <string>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// What a file of numbers a vertex holds. The reference is to a value that outlives the record.
struct DataRecord {
  const VertexData& data;
  std::string path;  // as it was named
  double seconds = 0;
};

/// As `sphparam info --json` tells it.
std::string to_json(const DataRecord& record);

/// Several lines for people: what it is, its columns with their ranges, and which commands take it.
std::string to_text(const DataRecord& record);

}  // namespace sphparam
