#include <catch2/catch.hpp>

#include "sphere/body_centre.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

TriangleMesh corner_of_cube() {
  TriangleMesh mesh;
  mesh.positions.resize(4, 3);
  mesh.positions << 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4;
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return mesh;
}

}  // namespace

TEST_CASE("body centre: the centroid of what is enclosed, wherever it lies and however it is cut") {
  TriangleMesh mesh = corner_of_cube();
  CHECK((enclosed_centroid(mesh) - Vector3(1, 1, 1)).norm() < 1e-14);
  mesh.triangles.col(0).swap(mesh.triangles.col(1));  // inside out
  CHECK((enclosed_centroid(mesh) - Vector3(1, 1, 1)).norm() < 1e-14);
  mesh.positions.rowwise() += Eigen::RowVector3d(1e6, -2e6, 5);
  CHECK((enclosed_centroid(mesh) - Vector3(1e6 + 1, -2e6 + 1, 6)).norm() < 1e-8);
  mesh.positions *= 1e120;
  CHECK((enclosed_centroid(mesh) / 1e120 - Vector3(1e6 + 1, -2e6 + 1, 6)).norm() < 1e-8);
}

TEST_CASE("body centre: of a sheet with two sides the mean of its vertices") {
  TriangleMesh sheet;
  sheet.positions.resize(3, 3);
  sheet.positions << 0, 0, 1, 3, 0, 1, 0, 6, 1;
  sheet.triangles.resize(2, 3);
  sheet.triangles << 0, 1, 2, 2, 1, 0;
  CHECK(enclosed_centroid(sheet) == Vector3(1, 2, 1));
}

TEST_CASE("body centre: a surface winds about what is in it, whichever way it looks") {
  TriangleMesh mesh = corner_of_cube();
  for (const bool inverted : {false, true}) {
    if (inverted) mesh.triangles.col(0).swap(mesh.triangles.col(1));
    CHECK(winds_about(mesh, {1, 1, 1}));
    CHECK(winds_about(mesh, {0.01, 0.01, 0.01}));
    CHECK_FALSE(winds_about(mesh, {-0.01, 1, 1}));
    CHECK_FALSE(winds_about(mesh, {2, 2, 2}));  // in the box
    CHECK_FALSE(winds_about(mesh, {1e9, 0, 0}));
    CHECK(winds_about(mesh, {0, 4, 0}));  // a vertex
  }
}

TEST_CASE("body centre: one outside is told with the centroid, one inside is not") {
  CHECK(line_of_outside(corner_of_cube(), {1, 1, 0.5}).empty());
  CHECK(line_of_outside(corner_of_cube(), {2, 2.5, 0}) ==
        "the centre 2,2.5,0 lies outside of the surface: --centre centroid is 1,1,1, that of what "
        "it encloses");
}

TEST_CASE("body centre: a centroid that is outside itself is not recommended") {
  // An L, with arms 9 long and 1 thick.
  TriangleMesh mesh;
  mesh.positions.resize(12, 3);
  mesh.positions << 0, 0, 0, 9, 0, 0, 9, 1, 0, 1, 1, 0, 1, 9, 0, 0, 9, 0,  //
      0, 0, 1, 9, 0, 1, 9, 1, 1, 1, 1, 1, 1, 9, 1, 0, 9, 1;
  mesh.triangles.resize(20, 3);
  mesh.triangles << 3, 2, 1, 3, 1, 0, 3, 0, 5, 3, 5, 4,  //
      9, 7, 8, 9, 6, 7, 9, 11, 6, 9, 10, 11,             //
      0, 1, 7, 0, 7, 6, 1, 2, 8, 1, 8, 7, 2, 3, 9, 2, 9, 8, 3, 4, 10, 3, 10, 9, 4, 5, 11, 4, 11, 10,
      5, 0, 6, 5, 6, 11;
  const Vector3 centroid(89.0 / 34, 89.0 / 34, 0.5);  // of 9 at (4.5, 0.5) and 8 at (0.5, 5)
  CHECK((enclosed_centroid(mesh) - centroid).norm() < 1e-14);
  CHECK(winds_about(mesh, {0.5, 0.5, 0.5}));
  CHECK(line_of_outside(mesh, centroid) ==
        "the centre 2.61765,2.61765,0.5 lies outside of the surface, as the centroid of what it "
        "encloses "
        "does");
}

TEST_CASE("body centre: far from the origin it has the digits that the place needs") {
  TriangleMesh mesh = corner_of_cube();
  mesh.positions.rowwise() += Vector3(500000.25, 5200000.5, 0).transpose();
  CHECK_THAT(line_of_outside(mesh, Vector3::Zero()),
             Catch::Contains("--centre centroid is 500001.25,5200001.5,1, that of what"));
}
