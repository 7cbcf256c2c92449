#pragma once

#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

/// A polyhedron about the origin.
struct Polyhedron {
  std::vector<Vector3> corners;
  int degree;              // of its faces
  std::vector<int> faces;  // degree·#F indices, counter-clockwise from outside
};
Polyhedron icosahedron();  // corners on the unit sphere, two of them at ±z
Polyhedron octahedron();   // ±x, ±y, ±z
Polyhedron cube();         // ±1

/// Where the vertices of a subdivided polyhedron are.
enum class Placement {
  Halved,  // each middle is put on the sphere before the next level
  Flat,    // middles stay on the flat polyhedron, in exact multiples of 2^−levels
};

/// The topology of `levels` subdivisions, OpenSubdiv's by Loop's or Catmull and Clark's scheme, on
/// the middles of edges and faces; no limit surface: that of an icosahedron is no sphere.
/// Requires: levels ≤ 14.
SphereGrid subdivide(const Polyhedron& polyhedron, int levels, Placement placement,
                     const GridOptions& options);

}  // namespace sphparam
