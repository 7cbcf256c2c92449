#pragma once

#include <cmath>
#include <numbers>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// A closed torus about z: `around` × `across` vertices, twice as many triangles. `large`: radius
/// of the middle of the tube; `small`: of the tube.
inline TriangleMesh torus(int around, int across, double large, double small) {
  constexpr double turn = 2 * std::numbers::pi;
  TriangleMesh mesh{Points(around * across, 3), Triangles(2 * around * across, 3)};
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = turn * i / around, v = turn * j / across, r = large + small * std::cos(v);
      mesh.positions.row(at(i, j)) << r * std::cos(u), r * std::sin(u), small * std::sin(v);
      mesh.triangles.row(2 * at(i, j)) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      mesh.triangles.row(2 * at(i, j) + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  return mesh;
}

}  // namespace sphparam::tests
