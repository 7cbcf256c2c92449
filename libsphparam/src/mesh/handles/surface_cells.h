#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/repair/repair_state.h"
#include "mesh/triangle_crossing.h"

namespace sphparam {

/// The faces that a surface has now, by the cells of a grid about it: which are near a triangle.
class SurfaceCells {
 public:
  /// `state` outlives this; its faces may get other names of vertices at the same places, and more
  /// may come, which are not looked at. Cost: linear; 64 numbers a face at most.
  explicit SurfaceCells(const RepairState& state);

  /// How many of these faces the triangle crosses (`triangles_cross`): those that have a corner at
  /// the same place as the triangle are not looked at. Requires: places in the unit box.
  long crossings(const TriangleCorners& triangle) const;

 private:
  TriangleCorners triangle(Face f) const;
  std::array<int, 3> cell_of(const Vector3& place) const;
  std::int64_t entries() const;
  template <class Visit>
  void for_each_cell(const TriangleCorners& triangle, const Visit& visit) const;

  const RepairState& state_;
  int cells_;               // a side
  std::vector<int> first_;  // per cell, and the end
  std::vector<Face> faces_;
};

}  // namespace sphparam
