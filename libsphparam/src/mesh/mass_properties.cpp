#include "sphparam/mesh/mass_properties.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "mesh/box.h"

namespace sphparam {
namespace {

/// ∫ 1, x and x xᵀ over what is enclosed, x counted from a point, in units of a size.
struct Moments {
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

Moments moments_about(const TriangleMesh& mesh, const Vector3& point, double size) {
  Moments sum;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      corners.col(k) = (mesh.position(mesh.triangles(f, k)) - point) / size;
    }
    const Vector3 all = corners.rowwise().sum();
    const double determinant = corners.determinant();
    sum.volume += determinant / 6;
    sum.first += determinant / 24 * all;
    sum.second += determinant / 120 * (all * all.transpose() + corners * corners.transpose());
  }
  return sum;
}

void point_ahead(Eigen::Ref<Vector3> axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  if (axis[largest] < 0) axis = -axis;
}

void find_axes(MassProperties& body) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(body.inertia);
  Vector3 first = solver.eigenvectors().col(0), second = solver.eigenvectors().col(1);
  point_ahead(first);
  point_ahead(second);
  body.moments = solver.eigenvalues();
  body.axes << first.transpose(), second.transpose(), first.cross(second).transpose();
}

Vector3 extents_along(const Eigen::Matrix3d& axes, const TriangleMesh& mesh,
                      const Vector3& centre) {
  Box box;
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
    box.add(axes * (mesh.position(mesh.triangles.data()[i]) - centre));
  return box.upper - box.lower;
}

}  // namespace

std::optional<MassProperties> mass_properties(const TriangleMesh& mesh) {
  constexpr double next_to_nothing = 1e-12;
  const Box box = surface_box(mesh);
  const double size = box.longest_side();
  const Vector3 middle = box.lower / 2 + box.upper / 2;
  const Moments about_middle = moments_about(mesh, middle, size);
  if (!(std::abs(about_middle.volume) > next_to_nothing)) return std::nullopt;
  MassProperties body;
  body.centroid = middle + about_middle.first / about_middle.volume * size;
  const Moments moments = moments_about(mesh, body.centroid, size);
  const Vector3 rest = moments.first / moments.volume;
  const Eigen::Matrix3d second = moments.second - moments.volume * rest * rest.transpose();
  body.volume = moments.volume * size * size * size;
  const double unit = (moments.volume < 0 ? -1 : 1) * size * size * size * size * size;
  body.inertia = unit * (second.trace() * Eigen::Matrix3d::Identity() - second);
  find_axes(body);
  body.extents = extents_along(body.axes, mesh, body.centroid);
  return body;
}

}  // namespace sphparam
