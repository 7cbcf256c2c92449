#include "sphparam/group/surface_size.h"

#include <cmath>

#include "mesh/triangle_geometry.h"

// Over a triangle of area A with corners pᵢ, ∫ x = A Σ pᵢ / 3 and, of corners qᵢ = pᵢ − c,
// ∫ |x − c|² = A (Σ |qᵢ|² + |Σ qᵢ|²) / 12. All from the first corner and in lengths of the
// box about it: far from the origin nothing is lost, and no square is out of range.

namespace sphparam {
namespace {

using Corners = Eigen::Matrix3d;  // a row a corner

double area_of(const Corners& corners) {
  return triangle_area(corners.row(0), corners.row(1), corners.row(2));
}

}  // namespace

double surface_size(const TriangleMesh& surface) {
  if (surface.face_count() == 0) return 0;
  const Vector3 origin = surface.position(surface.triangles(0, 0));
  Vector3 least = origin, most = origin;
  for (const Vertex v : surface.triangles.reshaped()) {
    least = least.cwiseMin(surface.position(v));
    most = most.cwiseMax(surface.position(v));
  }
  const double unit = (most - least).maxCoeff();
  if (!(unit > 0)) return 0;
  const auto corners_of = [&](Face f, const Vector3& centre) {
    Corners corners;
    for (int k = 0; k < 3; ++k)
      corners.row(k) = (surface.position(surface.triangles(f, k)) - origin) / unit - centre;
    return corners;
  };
  double area = 0;
  Vector3 sum = Vector3::Zero();
  for (Face f = 0; f < surface.face_count(); ++f) {
    const Corners corners = corners_of(f, Vector3::Zero());
    area += area_of(corners);
    sum += area_of(corners) / 3 * corners.colwise().sum().transpose();
  }
  if (!(area > 0)) return 0;
  const Vector3 centroid = sum / area;
  double squares = 0;
  for (Face f = 0; f < surface.face_count(); ++f) {
    const Corners corners = corners_of(f, centroid);
    squares +=
        area_of(corners) / 12 * (corners.squaredNorm() + corners.colwise().sum().squaredNorm());
  }
  return unit * std::sqrt(squares / area);
}

}  // namespace sphparam
