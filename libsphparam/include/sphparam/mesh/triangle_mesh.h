#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sphparam {

using Vector3 = Eigen::Vector3d;

/// #V×3 coordinates, one point a row, stored x y z x y z …
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// #F×3 vertex indices, one triangle a row, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Indices into a mesh. A *wedge* (a copy of a vertex across the cut) has a type of its own, see
/// curvilinear/cut_mesh.h.
using Vertex = int;
using Face = int;
using Halfedge = int;

/// A triangle mesh as plain data. Nothing is promised about it: `inspect_mesh` says what is wrong
/// with it, and `Topology` can only be made from a mesh that is closed and manifold.
struct TriangleMesh {
  Points positions;
  Triangles triangles;

  Eigen::Index vertex_count() const { return positions.rows(); }
  Eigen::Index face_count() const { return triangles.rows(); }
  Vector3 position(Vertex v) const { return positions.row(v); }
};

}  // namespace sphparam
