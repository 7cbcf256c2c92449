#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sphparam {

using Vector3 = Eigen::Vector3d;

/// What passes between the library and a program that was compiled with other flags. Eigen
/// allocates its own matrices by the widest vectors that are compiled for (-march=native), and
/// frees them by the same rule: made by one side and freed by the other, they end in a crash. These
/// come from malloc on both sides. All that public headers name is made of these and of fixed ones
/// that nothing aligns.
template <class Scalar, int Columns>
using RowTable = Eigen::Matrix<Scalar, Eigen::Dynamic, Columns, Eigen::RowMajor | Eigen::DontAlign>;
using VectorX = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::DontAlign>;
using MatrixX = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::DontAlign>;

/// #V×3 coordinates, one point a row, stored x y z x y z …
using Points = RowTable<double, 3>;

/// #F×3 vertex indices, one triangle a row, counter-clockwise seen from outside.
using Triangles = RowTable<int, 3>;

/// Indices into a mesh. A *wedge* (a copy of a vertex across the cut) has a type of its own
/// where meshes are cut.
using Vertex = int;
using Face = int;
using Halfedge = int;

/// A triangle mesh as plain data. Nothing is promised about it: `inspect_mesh` says what is wrong
/// with it, and `Topology` can only be made from a mesh that is closed and manifold.
struct TriangleMesh {
  Points positions;     // a row a vertex
  Triangles triangles;  // a row a face, of indices of vertices

  Eigen::Index vertex_count() const { return positions.rows(); }
  Eigen::Index face_count() const { return triangles.rows(); }
  Vector3 position(Vertex v) const { return positions.row(v); }
};

}  // namespace sphparam
