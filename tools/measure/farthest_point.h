#pragma once

#include "rays/ray_scene.h"

namespace sphparam::tools {

/// The point of a surface that is farthest from another surface.
struct FarthestPoint {
  Vector3 point = Vector3::Zero();
  double distance = -1;
  double at_most = 0;  // no point of the surface is farther
};

/// Looks for a point farther than `known` where one can be: distances change by no more than the
/// way between two points, so the corners of a triangle bound the distance of all its points.
/// Triangles of the largest bound are halved until none promises a thousandth more than the
/// farthest point found, or 16,384 distances have been measured.
/// Source: branch and bound as in Tang, Lee and Kim, "Interactive Hausdorff distance computation
/// for general polygonal models" (2009), with bounds from corners only.
/// Requires: at_vertices[v], the distance of vertex v. Ensures: known.distance ≤ distance ≤
/// at_most.
FarthestPoint find_farthest(const TriangleMesh& from, const Eigen::VectorXd& at_vertices,
                            const RayScene& to, const FarthestPoint& known);

}  // namespace sphparam::tools
