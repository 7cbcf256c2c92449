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

  /// Up to 48 triangles of up to 16 vertices, none of which is twice in one, or a mesh as above of
  /// which some triangles are turned, moved to other vertices or left out.
  TriangleMesh soup();

 private:
  Triangles loose_triangles(int vertices);
  void hurt(TriangleMesh& mesh);
  Points places(Eigen::Index vertices, unsigned style);
  double coordinate(unsigned style);

  std::span<const std::uint8_t> bytes_;
};

}  // namespace sphparam::tests
