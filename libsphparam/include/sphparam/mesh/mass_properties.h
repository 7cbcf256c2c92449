#pragma once

#include <optional>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Of what a closed surface encloses, as a body of density 1 in the mesh's units. Nothing of it but
/// the sign of `volume` depends on which way the faces are wound.
struct MassProperties {
  double volume = 0;  // signed, as in MeshInspection
  Vector3 centroid = Vector3::Zero();
  /// About the centroid, along the mesh's axes: ∫ (|r|² I − r rᵀ) dV.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  /// Its eigenvalues, ascending: the first axis is the long one of the body.
  Vector3 moments = Vector3::Zero();
  /// A row a principal axis: unit, right-handed; of the first two the coordinate that is largest is
  /// positive. Where two moments are the same, any two axes of their plane.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /// How far the surface reaches along each of them: length, width and thickness.
  Vector3 extents = Vector3::Zero();
};

/// Sums over tetrahedra, signed, of the faces and a point inside the bounding box: exact up to
/// rounding, wherever the mesh lies. What is enclosed twice counts twice.
/// Nothing where next to nothing is enclosed (less than 1e-12 of the cube of the bounding box's
/// longest side), as of a sheet. Requires: a closed surface; finite positions; faces name vertices
/// that are there. Cost: two passes.
/// Source: the moments of a simplex; Eberly, "Polyhedral mass properties (revisited)" (2002).
std::optional<MassProperties> mass_properties(const TriangleMesh& mesh);

}  // namespace sphparam
