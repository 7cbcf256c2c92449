#include "rays/scene_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace sphparam {
namespace {

SceneFrame frame_of(const TriangleMesh& mesh) {
  if (mesh.face_count() == 0) throw std::invalid_argument("RayScene: no triangles");
  if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.vertex_count())
    throw std::invalid_argument("RayScene: a triangle names a vertex that is not there");
  Vector3 lower = mesh.position(mesh.triangles(0, 0)), upper = lower;
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 corner = mesh.position(mesh.triangles.data()[i]);
    if (!corner.allFinite()) throw std::invalid_argument("RayScene: not finite");
    lower = lower.cwiseMin(corner);
    upper = upper.cwiseMax(corner);
  }
  // Halves first: the difference of two large numbers may be none.
  const Vector3 halves = upper / 2 - lower / 2;
  const double half = halves.maxCoeff();
  int exponent = 0;
  std::frexp(half, &exponent);
  constexpr int greatest = 1000;  // 2¹⁰²⁴ is infinite, and numbers below the normal ask for more
  return {lower + halves, half > 0 ? std::ldexp(1.0, std::min(greatest, -exponent)) : 1.0,
          2 * halves.stableNorm(), std::nullopt};
}

/// How many boxes of triangles a place of the mesh's box is in, by and large: Σ surface of their
/// boxes / surface of the mesh's. Some 4 where triangles are compact, as many as there are where
/// each goes from end to end.
double overlap(const TriangleMesh& mesh, const SceneFrame& frame) {
  const auto half_surface = [](const Vector3& size) {
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  };
  Eigen::AlignedBox3d whole;
  double sum = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 3; ++k) box.extend(frame.local(mesh.position(mesh.triangles(f, k))));
    sum += half_surface(box.sizes());
    whole.extend(box);
  }
  const double all = half_surface(whole.sizes());
  return all > 0 ? sum / all : 0;
}

/// The frame turned along the triangles, where that makes their boxes overlap much less.
SceneFrame turned(const TriangleMesh& mesh, const SceneFrame& frame) {
  constexpr double crowded = 32, worthwhile = 0.5;
  const double given = overlap(mesh, frame);
  if (!(given > crowded)) return frame;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 side = frame.local(mesh.position(mesh.triangles(f, (k + 1) % 3))) -
                           frame.local(mesh.position(mesh.triangles(f, k)));
      squares += side * side.transpose();
    }
  }
  SceneFrame other = frame;
  other.turn =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors().transpose().eval();
  return overlap(mesh, other) < worthwhile * given ? other : frame;
}

}  // namespace

SceneFrame scene_frame(const TriangleMesh& mesh) { return turned(mesh, frame_of(mesh)); }

}  // namespace sphparam
