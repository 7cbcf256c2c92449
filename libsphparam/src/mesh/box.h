#pragma once

#include <limits>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// An upright box about points.
struct Box {
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 upper = -lower;

  void add(const Vector3& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  /// 0 without points.
  double longest_side() const { return (upper - lower).cwiseMax(0).maxCoeff(); }
};

inline Box box_of(const Points& positions) {
  Box box;
  for (Eigen::Index i = 0; i < positions.rows(); ++i) box.add(positions.row(i));
  return box;
}

/// About the vertices that faces name: others are nowhere on the surface, and may be anywhere.
/// Where no face names one that is there, about all.
inline Box surface_box(const TriangleMesh& mesh) {
  Box box;
  bool any = false;
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    const Vertex v = mesh.triangles.data()[i];
    if (v < 0 || v >= mesh.vertex_count()) continue;
    box.add(mesh.position(v));
    any = true;
  }
  return any ? box : box_of(mesh.positions);
}

inline double longest_side(const TriangleMesh& mesh) {
  return box_of(mesh.positions).longest_side();
}

}  // namespace sphparam
