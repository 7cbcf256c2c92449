#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sphparam/io/scalar_type.h"

namespace sphparam {

/// One attribute of a mesh compressed by Draco: which one, and as what its numbers are wanted.
struct DracoAttribute {
  std::uint32_t id = 0;
  ScalarType type = ScalarType::Float32;
  int components = 1;
  std::vector<unsigned char> rows = {};  // decoded: components of the type, a row a point
};

struct DracoMesh {
  std::uint64_t points = 0;
  std::vector<std::uint32_t> corners;  // three a triangle, each < points
  std::vector<DracoAttribute> attributes;
};

/// Decodes a mesh and the attributes that are wanted, in their order, their numbers little endian.
/// Throws: std::runtime_error that says what is wrong.
DracoMesh decode_draco(std::span<const unsigned char> bytes, std::vector<DracoAttribute> wanted);

}  // namespace sphparam
