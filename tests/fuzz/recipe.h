#pragma once

#include <cstdint>
#include <span>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// Bytes that say how a mesh is made. Every string of bytes is a recipe: where they end, zeros
/// follow. So a fuzzer wastes no input on files that are refused.
class Recipe {
 public:
  explicit Recipe(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  unsigned byte();

  /// A closed genus-0 mesh of 4 to 67 vertices: a tetrahedron, changed by 1→3 splits and edge flips
  /// (which reach every triangulation of the sphere), with positions on a coarse grid (many
  /// coincide), anywhere, or far apart in size.
  TriangleMesh sphere_mesh();

 private:
  double coordinate(unsigned style);

  std::span<const std::uint8_t> bytes_;
};

}  // namespace sphparam::tests
