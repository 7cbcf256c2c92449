#pragma once

#include "sphparam/mesh/triangle_mesh.h"

/// Meshes that tests are made of: small, closed, genus 0, counter-clockwise from outside.
namespace sphparam::tests {

TriangleMesh tetrahedron();
TriangleMesh octahedron();
TriangleMesh icosahedron();

/// The icosahedron subdivided `level` times, on the unit sphere: 20·4^level triangles.
TriangleMesh icosphere(int level);

/// Latitude–longitude sphere with two pole vertices (0: north, last: south), the rings between.
TriangleMesh uv_sphere(int meridians, int rings);

/// A closed tube along z: `rings` rings of `around` vertices a distance 1 apart, radius 1, a vertex
/// at each end. Long tubes are the limbs that collapse linear methods.
TriangleMesh tube(int rings, int around);

/// A random triangulation of the sphere: insertions into random faces of a tetrahedron and random
/// edge flips, deterministic in `seed`; positions are random points near the unit sphere, so the
/// shape crumples and intersects itself: only its connectivity is a sphere.
TriangleMesh random_sphere_mesh(int vertices, unsigned seed);

/// A sphere whose vertices but for those of a cap are all in one place: its map has triangles
/// too small for numbers of 32 bits.
TriangleMesh gathered_sphere();

/// The same mesh with vertices renamed and faces shuffled and rotated.
TriangleMesh relabelled(const TriangleMesh& mesh, unsigned seed);

/// The rays of `uv_sphere(meridians, rings)` with every longitude multiplied by `turns`: all
/// determinants stay positive (for meridians > 2·turns), yet the sphere is covered `turns` times.
Points wound_rays(int meridians, int rings, int turns);

}  // namespace sphparam::tests
