#include <catch2/catch.hpp>
#include <random>

#include "measure/enclosure.h"
#include "support/cube.h"
#include "support/joined.h"
#include "support/test_meshes.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

TriangleMesh turned_over(TriangleMesh mesh) {
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

/// The cube with its top in triangles from a point of an edge, which the face beside does not have:
/// one without area lies between.
TriangleMesh cube_with_a_flat_face() {
  const TriangleMesh plain = cube();
  TriangleMesh mesh{Points(9, 3), Triangles(14, 3)};
  mesh.positions << plain.positions, Eigen::RowVector3d(0, -1, 1);
  mesh.triangles.topRows(2) = plain.triangles.topRows(2);
  mesh.triangles.bottomRows(8) = plain.triangles.bottomRows(8);
  mesh.triangles.middleRows(2, 4) << 8, 5, 7, 8, 7, 6, 8, 6, 4, 4, 5, 8;
  return mesh;
}

}  // namespace

TEST_CASE("enclosure: what is open or turned is counted, what touches along an edge is closed") {
  const TriangleMesh ball = icosphere(2);
  CHECK(unclosed_edges(ball.triangles) == 0);
  CHECK(unclosed_edges(turned_over(ball).triangles) == 0);
  CHECK(unclosed_edges(ball.triangles.bottomRows(ball.face_count() - 1)) == 3);
  Triangles one_turned = ball.triangles;
  std::swap(one_turned(7, 1), one_turned(7, 2));
  CHECK(unclosed_edges(one_turned) == 3);
  TriangleMesh touching = joined(cube(), cube(), {2, 2, 0});
  touching.triangles = (touching.triangles.array() == 8).select(3, touching.triangles);
  touching.triangles = (touching.triangles.array() == 12).select(7, touching.triangles);
  CHECK(unclosed_edges(touching.triangles) == 0);
  CHECK(unclosed_edges(Triangles(0, 3)) == 0);
}

TEST_CASE("enclosure: of a cube, points far and near, above faces, edges and corners") {
  for (const TriangleMesh& mesh : {cube(), turned_over(cube()), cube_with_a_flat_face()}) {
    REQUIRE(unclosed_edges(mesh.triangles) == 0);
    const Enclosure inside(mesh);
    for (const double off : {0.5, 1e-3, 1e-9}) {
      for (const Vector3& place : {Vector3(0, 0, 1), Vector3(0, -1, 1), Vector3(1, 1, 1),
                                   Vector3(0.3, -1, 1), Vector3(0, 0, -1), Vector3(1, 0.2, 0)}) {
        INFO(off << " about " << place.transpose());
        CHECK(inside.holds(place * (1 - off)));
        CHECK_FALSE(inside.holds(place * (1 + off)));
      }
      CHECK_FALSE(inside.holds({0, -1 + off, 1 + off}));
      CHECK_FALSE(inside.holds({0, -1 - off, 1 - off}));
      CHECK(inside.holds({0, -1 + off, 1 - off}));
    }
    CHECK_FALSE(inside.holds({1e6, 0, 0}));
  }
}

TEST_CASE("enclosure: of many faces, the same as by their radius, also where two overlap") {
  const TriangleMesh ball = icosphere(5);
  const TriangleMesh both = joined(ball, ball, {1, 0, 0});
  const Enclosure inside(ball), either(both);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  const auto is_in = [](const Vector3& x) { return x.norm() < 0.999; };  // flat faces
  const auto is_out = [](const Vector3& x) { return x.norm() > 1; };
  int within = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3 x(place(random), place(random), place(random)), y = x - Vector3(1, 0, 0);
    if (is_in(x)) CHECK(inside.holds(x));
    if (is_out(x)) CHECK_FALSE(inside.holds(x));
    if (is_in(x) || is_in(y)) CHECK(either.holds(x));
    if (is_out(x) && is_out(y)) CHECK_FALSE(either.holds(x));
    within += is_in(x);
  }
  CHECK(within > 500);
}

}  // namespace sphparam
