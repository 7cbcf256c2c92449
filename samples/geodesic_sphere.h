#pragma once

#include <array>

#include "sphparam/io/mesh_file.h"

namespace sphparam::samples {

/// The icosahedron, a vertex at each of ±z, as ten pairs of faces: pair i is the faces (P, Q, R)
/// and (S, R, Q) of `pairs[i]` = {P, Q, R, S}, counter-clockwise from outside.
struct Icosahedron {
  std::array<Vector3, 12> vertices;
  std::array<std::array<int, 4>, 10> pairs;
};
const Icosahedron& icosahedron();

/// The icosahedron with each face split into frequency² and pushed out to the unit sphere: 10·f²+2
/// vertices, 20·f² triangles. `texcoords` unrolls the pairs of faces to 5 × 2 squares of the unit
/// square, `margin` (a share of a square) away from their borders.
struct GeodesicSphere {
  TriangleMesh mesh;
  sphparam::CornerTexcoords texcoords;
};
GeodesicSphere geodesic_sphere(int frequency, double margin);

/// The direction that the atlas shows at (u, v), v upwards; in the margins the faces are continued.
Vector3 atlas_direction(double u, double v, double margin);

}  // namespace sphparam::samples
