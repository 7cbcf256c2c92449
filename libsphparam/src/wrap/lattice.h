#pragma once

#include <array>
#include <cstdint>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Points in rows, each joined to fourteen others: the seven whose coordinates are greater by 0 or
/// 1, and those that are smaller. These are the edges of cubes cut into six tetrahedra along one
/// diagonal (Freudenthal, Kuhn). Bits of a direction, 1 to 7: x, y, z are greater by 1.
struct Lattice {
  Vector3 origin = Vector3::Zero();
  double voxel = 1;
  std::array<int, 3> points = {0, 0, 0};  // each way

  std::int64_t size() const { return std::int64_t{points[0]} * points[1] * points[2]; }
  std::int64_t index(int x, int y, int z) const {
    return x + points[0] * (y + std::int64_t{points[1]} * z);
  }
  /// From a point to its neighbour in that direction.
  std::int64_t stride(int direction) const {
    return index(direction & 1, direction >> 1 & 1, direction >> 2 & 1);
  }
  Vector3 position(double x, double y, double z) const { return origin + voxel * Vector3(x, y, z); }

  static constexpr int neighbours = 14;
  /// All strides: those of directions 1 to 7, then back along them.
  std::array<std::int64_t, neighbours> strides() const {
    std::array<std::int64_t, neighbours> all{};
    for (int k = 0; k < 7; ++k) all[k] = stride(k + 1), all[k + 7] = -stride(k + 1);
    return all;
  }
};

}  // namespace sphparam
