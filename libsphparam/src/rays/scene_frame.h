#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <optional>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The coordinates in which rays are cast into a mesh: moved and scaled by a power of two into the
/// cube [−1, 1]³ in doubles, turned where that helps, then rounded to floats; each coordinate is
/// off by at most 2⁻²⁵, turned by 2⁻²⁴.
struct SceneFrame {
  Vector3 centre;
  double scale;  // a power of two
  double diagonal;
  std::optional<Eigen::Matrix3d> turn;  // where triangles lie across the axes: see `scene_frame`

  Vector3 local(const Vector3& point) const {
    const Vector3 moved = (point - centre) * scale;
    return turn ? Vector3(*turn * moved) : moved;
  }
  Eigen::Vector3f local_direction(const Eigen::Vector3f& direction) const {
    return turn ? Eigen::Vector3f(turn->cast<float>() * direction) : direction;
  }
  /// As Embree takes it: beyond, and where a mesh is one point that rounding misses, a ray meets
  /// nothing that floats could tell.
  Eigen::Vector3f local_origin(const Vector3& point) const {
    constexpr double farthest = 0x1p40;
    return local(point).cwiseMax(-farthest).cwiseMin(farthest).cast<float>();
  }
  float local_length(double length) const {
    return static_cast<float>(std::min<double>(length * scale, std::numeric_limits<float>::max()));
  }
};

/// The frame of a mesh, which reaches √3 from its centre at most.
///
/// Triangles that are long and lie across the axes have boxes that overlap, so that a search goes
/// through all of them. Where that is so, and many have one direction, the frame is turned until
/// that direction is an axis: the principal axes of the sides, each weighted by its squared length.
/// Throws: std::invalid_argument for a mesh without triangles, for indices out of range, and where
/// a triangle's corner is not finite. Cost: a few passes over the triangles.
SceneFrame scene_frame(const TriangleMesh& mesh);

}  // namespace sphparam
