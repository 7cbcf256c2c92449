#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "sphparam/correspondence/map_alignment.h"
#include "sphparam/parameterize.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A ball with three bumps of different sizes: it has no symmetry.
TriangleMesh bumpy(int level) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    double radius = 1, height = 0.9;
    for (const Vector3& bump : {Vector3(1, 0.2, 0.1), {-0.3, 1, 0.2}, {0.1, -0.4, 1}}) {
      radius += height * std::exp(-6 * (x - bump.normalized()).squaredNorm());
      height *= 0.6;
    }
    mesh.positions.row(v) = radius * x;
  }
  return mesh;
}

Eigen::Matrix3d rotation(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return (a - b).norm() / std::sqrt(2.0);
}

}  // namespace

TEST_CASE(
    "map_alignment: a map that is turned lies as it did, whatever the surface in space does") {
  const TriangleMesh mesh = bumpy(4);
  const MappedMesh to = mapped(mesh, parameterize(mesh).map);
  for (const double angle : {0.3, 1.7, 3.0}) {
    const Eigen::Matrix3d turn = rotation(angle, Vector3(1, -2, angle));
    TriangleMesh moved = mesh;
    moved.positions = (3 * mesh.positions * rotation(2, Vector3(3, 1, 1)).transpose()).eval();
    const MappedMesh from = turned_map(mapped(moved, to.map()), turn.transpose());
    const auto found = align_maps(from, to);
    CHECK(found.front().correlation > 0.99);
    CHECK(angle_between(found.front().rotation, turn) < 0.01);
    CHECK((turned_map(from, found.front().rotation).map().points - to.map().points)
              .cwiseAbs()
              .maxCoeff() < 0.01);
  }
}

TEST_CASE("map_alignment: maps of two meshes of one shape are turned onto each other") {
  const TriangleMesh mesh = bumpy(4);
  TriangleMesh other = relabelled(bumpy(3), 5);
  other.positions = (other.positions * rotation(1, Vector3(1, 1, 1)).transpose()).eval();
  const MappedMesh to = mapped(mesh, parameterize(mesh).map);
  const MappedMesh from = mapped(other, parameterize(other).map);
  const auto found = align_maps(from, to);
  CHECK(found.front().correlation > 0.9);
  // What is far out on one is where it is on the other.
  const MappedMesh turned = turned_map(from, found.front().rotation);
  const auto tip = [](const MappedMesh& m) {
    Eigen::Index farthest = 0;
    m.mesh().positions.rowwise().norm().maxCoeff(&farthest);
    return m.map().point(static_cast<Vertex>(farthest));
  };
  CHECK((tip(turned) - tip(to)).norm() < 0.15);
}

TEST_CASE("map_alignment: values of one's own decide, where they are given") {
  const TriangleMesh mesh = icosphere(3);  // nothing else tells one side of it from another
  const MappedMesh ball = mapped(mesh, SphereMap{mesh.positions});
  const Eigen::Matrix3d turn = rotation(1.2, Vector3(1, 2, 3));
  Functions from(mesh.vertex_count(), 1), to = from;
  const auto height = [](const Vector3& x) { return x.x() + x.y() * x.z() + std::pow(x.z(), 3); };
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    from(v, 0) = height(mesh.position(v));
    to(v, 0) = height(turn.transpose() * mesh.position(v));
  }
  const auto found = turns_by_correlation(map_signals(ball, from), map_signals(ball, to));
  CHECK(angle_between(found.front().rotation, turn) < 0.02);
  CHECK_THROWS_AS(map_signals(ball, from.topRows(3)), std::invalid_argument);
}
