#pragma once

#include <cstdint>
#include <vector>

#include "rays/ray_scene.h"

namespace sphparam {

/// The nearest points on another surface of a mesh's vertices.
struct VertexDistances {
  VectorX distances;
  std::vector<Face> nearest;  // the other surface's face
};

/// The point of a surface that is farthest from another surface.
struct FarthestPoint {
  Vector3 point = Vector3::Zero();
  double distance = -1;
  double at_most = 0;  // no point of the surface is farther, but for rounding
};

/// Looks for a point farther than `known` where one can be. The distance from one triangle of the
/// other surface is a convex function: in a triangle it is largest at a corner, which bounds the
/// distance from the surface. Triangles of the largest bound are cut until none promises a
/// thousandth more than the farthest point found, or 16,384 cuts have been made; then until none
/// promises twice as much, or four more a triangle have been, or `wanted_cuts` if that is more.
/// A cut takes 1 to 3 µs. Where the other surface has thousands of triangles along each of these,
/// the bound stays as loose as it is told.
/// Source: branch and bound as in Tang, Lee and Kim, "Interactive Hausdorff distance computation
/// for general polygonal models" (2009); where a piece is cut is our own.
/// Requires: `to` is the scene of `other`. Ensures: known.distance ≤ distance ≤ at_most; the same
/// bits for any number of threads.
FarthestPoint find_farthest(const TriangleMesh& from, const VertexDistances& vertices,
                            const TriangleMesh& other, const RayScene& to,
                            const FarthestPoint& known, std::int64_t wanted_cuts, int threads);

}  // namespace sphparam
