#pragma once

#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

// Centres of bodies: a point that a surface is looked at from, which may lie anywhere.

/// The centroid of what a closed surface encloses, as in `mass_properties`; the mean of its
/// vertices where that is next to nothing, as of a sheet. Requires: finite positions, at least one.
/// Cost: two passes.
Vector3 enclosed_centroid(const TriangleMesh& mesh);

/// Whether a closed surface has a point inside, by its winding number. A vertex counts;
/// of other points on it that is left to rounding.
/// Requires: finite positions and point. Cost: a pass, 50 ns a face.
bool winds_about(const TriangleMesh& mesh, const Vector3& point);

/// That a centre lies outside of a closed surface, where the centroid is, and the word that options
/// have for it, or that this lies outside, too; empty where it lies inside. Requires, cost: as
/// these.
std::string line_of_outside(const TriangleMesh& mesh, const Vector3& centre);

}  // namespace sphparam
