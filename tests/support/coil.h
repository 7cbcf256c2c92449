#pragma once

#include <cmath>
#include <numbers>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// A closed tube of radius 1, hexagonal, wound so often about the z axis at a distance of 10. Its
/// map winds about the poles, in triangles thin in (u, v) that lie on each other by the dozen.
inline TriangleMesh coil(int turns) {
  constexpr int rings_a_turn = 24, around = 6;
  constexpr double winding = 10, pitch = 3;
  const int rings = turns * rings_a_turn + 1, last = rings * around + 1;
  TriangleMesh mesh;
  mesh.positions.resize(last + 1, 3);
  for (int ring = 0; ring < rings; ++ring) {
    const double t = 2 * std::numbers::pi * ring / rings_a_turn, z = -pitch * ring / rings_a_turn;
    const auto point = [&](double out, double up) -> Eigen::RowVector3d {
      return {(winding + out) * std::cos(t), (winding + out) * std::sin(t), z + up};
    };
    if (ring == 0) mesh.positions.row(0) = point(0, 0);
    if (ring == rings - 1) mesh.positions.row(last) = point(0, 0);
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around;
      mesh.positions.row(1 + ring * around + i) = point(std::cos(a), std::sin(a));
    }
  }
  mesh.triangles.resize(2 * rings * around, 3);
  Eigen::Index f = 0;
  for (int i = 0; i < around; ++i) {
    const auto at = [&](int ring, int k) { return 1 + ring * around + (i + k) % around; };
    mesh.triangles.row(f++) << 0, at(0, 0), at(0, 1);
    mesh.triangles.row(f++) << last, at(rings - 1, 1), at(rings - 1, 0);
    for (int ring = 0; ring + 1 < rings; ++ring) {
      mesh.triangles.row(f++) << at(ring, 0), at(ring + 1, 0), at(ring + 1, 1);
      mesh.triangles.row(f++) << at(ring, 0), at(ring + 1, 1), at(ring, 1);
    }
  }
  return mesh;
}

}  // namespace sphparam::tests
