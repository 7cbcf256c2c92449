#include <catch2/catch.hpp>
#include <cmath>

#include "sphparam/mesh/mass_properties.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// With a corner at the origin.
TriangleMesh box_mesh(double a, double b, double c) {
  TriangleMesh mesh;
  mesh.positions.resize(8, 3);
  for (int i = 0; i < 8; ++i) mesh.positions.row(i) << (i & 1) * a, (i >> 1 & 1) * b, (i >> 2) * c;
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,  //
      2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5;
  return mesh;
}

void check_near(const Eigen::Matrix3d& found, const Eigen::Matrix3d& wanted, double margin) {
  INFO(found);
  CHECK((found - wanted).cwiseAbs().maxCoeff() <= margin);
}

}  // namespace

TEST_CASE("mass_properties: of a box, wherever it lies and however it is wound") {
  // V = 48; moments about the centroid V (b² + c²) / 12 and so on.
  const Vector3 moments(4 * (16 + 36), 4 * (4 + 36), 4 * (4 + 16));
  for (const Vector3& shift : {Vector3(0, 0, 0), Vector3(1000, -300, 7)}) {
    TriangleMesh mesh = box_mesh(2, 4, 6);
    mesh.positions.rowwise() += shift.transpose();
    for (const double sign : {1, -1}) {
      const MassProperties body = mass_properties(mesh).value();
      CHECK(body.volume == Approx(sign * 48).epsilon(1e-14));
      CHECK((body.centroid - shift - Vector3(1, 2, 3)).cwiseAbs().maxCoeff() < 1e-12);
      check_near(body.inertia, moments.asDiagonal(), 1e-10);
      CHECK((body.moments - moments.reverse()).cwiseAbs().maxCoeff() < 1e-10);
      Eigen::Matrix3d axes;
      axes << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // the longest side first
      check_near(body.axes, axes, 1e-12);
      CHECK((body.extents - Vector3(6, 4, 2)).cwiseAbs().maxCoeff() < 1e-12);
      mesh.triangles.col(1).swap(mesh.triangles.col(2));
    }
  }
}

TEST_CASE("mass_properties: of a box that is turned, its axes are") {
  TriangleMesh mesh = box_mesh(2, 4, 6);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Vector3(3, -1, 2).normalized()).toRotationMatrix();
  mesh.positions = (mesh.positions * turn.transpose()).eval();
  const MassProperties body = mass_properties(mesh).value();
  const Vector3 moments(80, 160, 208);
  CHECK((body.moments - moments).cwiseAbs().maxCoeff() < 1e-11);
  CHECK((body.centroid - turn * Vector3(1, 2, 3)).cwiseAbs().maxCoeff() < 1e-14);
  check_near(body.axes.transpose() * moments.asDiagonal() * body.axes, body.inertia, 1e-11);
  CHECK(std::abs(body.axes.row(0).dot(turn.col(2))) == Approx(1).epsilon(1e-13));
  CHECK(body.axes.determinant() == Approx(1).epsilon(1e-14));
}

TEST_CASE("mass_properties: of a tetrahedron at the origin") {
  // ∫ x = 1/24, ∫ x² = 1/60, ∫ xy = 1/120; V = 1/6.
  TriangleMesh mesh;
  mesh.positions.resize(4, 3);
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  const MassProperties body = mass_properties(mesh).value();
  CHECK(body.volume == Approx(1. / 6).epsilon(1e-15));
  CHECK((body.centroid - Vector3::Constant(0.25)).cwiseAbs().maxCoeff() < 1e-15);
  const double own = 1. / 60 - 1. / 96, mixed = 1. / 120 - 1. / 96;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Constant(-mixed);
  inertia.diagonal().setConstant(2 * own);
  check_near(body.inertia, inertia, 1e-16);
}

TEST_CASE("mass_properties: a sheet has none, a body of any size has") {
  TriangleMesh sheet = icosphere(2);
  sheet.positions.col(2).setZero();
  CHECK_FALSE(mass_properties(sheet));
  TriangleMesh point = icosphere(0);
  point.positions.setOnes();
  CHECK_FALSE(mass_properties(point));
  const MassProperties one = mass_properties(box_mesh(2, 4, 6)).value();
  for (const double size : {0x1p-60, 0x1p60}) {
    TriangleMesh mesh = box_mesh(2, 4, 6);
    mesh.positions *= size;
    const MassProperties body = mass_properties(mesh).value();
    CHECK(body.centroid == one.centroid * size);
    CHECK(body.inertia == one.inertia * std::pow(size, 5));
  }
}
