#include "mesh/vertex_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "elementary.h"

namespace sphparam {
namespace {

/// A power of two that keeps sums of products of two edges finite, and those of tiny meshes above
/// 0; 1 for meshes that need none.
double harmless_scale(const TriangleMesh& mesh) {
  constexpr int greatest = 480, least = -400;  // powers of two
  const double largest = mesh.positions.size() > 0 ? mesh.positions.cwiseAbs().maxCoeff() : 0;
  if (!(largest > 0)) return 1;
  const int size = std::ilogb(largest);
  if (size > greatest) return std::ldexp(1.0, greatest - size);
  return size < least ? std::ldexp(1.0, std::min(1023, -size)) : 1;
}

/// Sums at the vertices to unit vectors. (By one thread: the sums before it take as long.)
void normalize(Points& normals) {
  for (Vertex v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).stableNorm();
    if (length > 0) {
      normals.row(v) /= length;
    } else {
      normals.row(v) = Vector3::UnitZ();
    }
  }
}

/// Unit sums of the faces' normals, as long as twice the area, times `weight_of`(that normal, the
/// two edges at the corner).
template <class WeightOf>
Points mean_of_faces(const TriangleMesh& mesh, const WeightOf& weight_of) {
  Points normals = Points::Zero(mesh.vertex_count(), 3);
  const double scale = harmless_scale(mesh);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) -> Vector3 {
      return scale * mesh.position(mesh.triangles(f, k % 3));
    };
    const Vector3 a = corner(0), n = (corner(1) - a).cross(corner(2) - a);
    for (int k = 0; k < 3; ++k)
      normals.row(mesh.triangles(f, k)) +=
          weight_of(n, corner(k + 1) - corner(k), corner(k + 2) - corner(k)) * n;
  }
  normalize(normals);
  return normals;
}

}  // namespace

Points vertex_normals(const TriangleMesh& mesh) {
  return mean_of_faces(mesh, [](const Vector3&, const Vector3&, const Vector3&) { return 1.0; });
}

Points angle_weighted_normals(const TriangleMesh& mesh) {
  return mean_of_faces(mesh, [](const Vector3& n, const Vector3& one, const Vector3& other) {
    const double length = n.stableNorm();
    return length > 0 ? elementary::atan2(length, one.dot(other)) / length : 0;
  });
}

}  // namespace sphparam
