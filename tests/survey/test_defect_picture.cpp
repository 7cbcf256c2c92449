#include <catch2/catch.hpp>
#include <limits>

#include "support/test_meshes.h"
#include "survey/defect_picture.h"

namespace sphparam::tests {

namespace {

DefectPicture picture_of(const TriangleMesh& mesh) {
  MeshSource source;
  source.file.mesh = mesh;
  source.inspection = inspect_mesh(mesh);
  return picture_of_defects(source, {}, {.picture_size = 64});
}

}  // namespace

TEST_CASE("defect picture: a hole is seen from its side, a whole mesh from no side of its own") {
  TriangleMesh open = icosphere(3);
  const Face last = open.face_count() - 1;
  Vector3 middle = Vector3::Zero();
  for (int k = 0; k < 3; ++k) middle += open.position(open.triangles(last, k)) / 3;
  open.triangles.conservativeResize(last, 3);
  const DefectPicture picture = picture_of(open);
  CHECK(picture.png.starts_with("\x89PNG"));
  REQUIRE(picture.from);
  CHECK(picture.from->normalized().dot(middle.normalized()) > 0.6);
  CHECK_FALSE(picture_of(icosphere(2)).from);
}

TEST_CASE("defect picture: a vertex that is no number is shown where its neighbours are") {
  const TriangleMesh ball = icosphere(3);
  for (const Vertex v : {5, 40, 99, 300}) {
    TriangleMesh mesh = ball;
    mesh.positions(v, 1) = std::numeric_limits<double>::quiet_NaN();
    const DefectPicture picture = picture_of(mesh);
    CHECK(picture.png.starts_with("\x89PNG"));
    REQUIRE(picture.from);
    CHECK(picture.from->normalized().dot(ball.position(v)) > 0.6);
  }
}

}  // namespace sphparam::tests
