#pragma once

#include "chart/refined_mesh.h"

namespace sphparam {

/// What `split_at_poles_and_meridian` found and did.
struct PolarFrame {
  Vertex north = -1, south = -1;
  int pole_splits = 0, meridian_splits = 0, snapped_vertices = 0;
};

/// Makes ±z vertices and the half-circle θ = 0 edges: afterwards no face crosses it.
///
/// Vertices closer than a named rounding to ±z or to the half-circle are moved there, where their
/// triangles stay positive; edges that close to ±z are split there.
/// Throws: std::invalid_argument where no face holds ±z. Cost: one pass, and the splits.
PolarFrame split_at_poles_and_meridian(RefinedMesh& mesh, int threads);

/// The faces that have corners with y < 0 and with y > 0, or corners within rounding of y = 0: all
/// that can touch ±z or the meridian, in order.
std::vector<Face> faces_around_meridian(const RefinedMesh& mesh, int threads);

/// Is the ray in the closed cone of the face? Exact, if the face is positive.
bool holds(const RefinedMesh& mesh, Face f, const Vector3& ray);

}  // namespace sphparam
