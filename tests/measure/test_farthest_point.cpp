#include <catch2/catch.hpp>
#include <cmath>

#include "measure/farthest_point.h"
#include "support/hedgehog.h"
#include "support/test_meshes.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

TriangleMesh triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  TriangleMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.positions << a.transpose(), b.transpose(), c.transpose();
  mesh.triangles << 0, 1, 2;
  return mesh;
}

/// n×n cells of length 1, each of two triangles, from (start, start, height) on.
TriangleMesh grid(int n, double start, double height) {
  TriangleMesh mesh{Points((n + 1) * (n + 1), 3), Triangles(2 * n * n, 3)};
  for (int v = 0; v < mesh.vertex_count(); ++v)
    mesh.positions.row(v) << start + v / (n + 1), start + v % (n + 1), height;
  for (int cell = 0; cell < n * n; ++cell) {
    const int v = cell / n * (n + 1) + cell % n;
    mesh.triangles.row(2 * cell) << v, v + n + 1, v + n + 2;
    mesh.triangles.row(2 * cell + 1) << v, v + n + 2, v + 1;
  }
  return mesh;
}

/// From what is known, or the vertices if they are farther.
FarthestPoint farthest(const TriangleMesh& from, const TriangleMesh& to, FarthestPoint known = {},
                       std::int64_t cuts = 0) {
  const RayScene scene(to);
  VertexDistances vertices = {Eigen::VectorXd(from.vertex_count()), {}};
  for (int v = 0; v < from.vertex_count(); ++v) {
    const NearestPoint found = scene.nearest(from.position(v));
    vertices.distances[v] = std::sqrt(found.squared_distance);
    vertices.nearest.push_back(found.on.face);
    if (vertices.distances[v] > known.distance)
      known = {.point = from.position(v), .distance = vertices.distances[v]};
  }
  const FarthestPoint one = find_farthest(from, vertices, to, scene, known, cuts, 1);
  const FarthestPoint two = find_farthest(from, vertices, to, scene, known, cuts, 2);
  CHECK(one.point == two.point);
  CHECK(one.at_most == two.at_most);
  return one;
}

}  // namespace

TEST_CASE("farthest point: inside a triangle whose corners are all on the other surface") {
  // Three small triangles at the corners of a large one: farthest is its circumcentre.
  const Vector3 a(0, 0, 0), b(6, 0, 0), c(3, 5, 0);
  TriangleMesh spots{Points(9, 3), Triangles(3, 3)};
  int row = 0;
  for (const Vector3& corner : {a, b, c}) {
    spots.positions.row(row) = corner;
    spots.positions.row(row + 1) = corner - Vector3(0, 0, 1);
    spots.positions.row(row + 2) = corner - Vector3(0, 0, 2);
    spots.triangles.row(row / 3) << row, row + 1, row + 2;
    row += 3;
  }
  const FarthestPoint found = farthest(triangle(a, b, c), spots);
  const Vector3 centre(3, 1.6, 0);  // 3² + 1.6² = (5 − 1.6)²
  CHECK(found.distance <= 3.4 + 1e-12);
  CHECK(found.distance >= 3.4 / 1.001);
  CHECK(found.at_most >= 3.4);
  CHECK(found.at_most <= 3.4 * 1.002);
  CHECK((found.point - centre).norm() < 0.1);
}

TEST_CASE("farthest point: over a pit whose walls each lie along a side, in one cut at its foot") {
  // The walls are planes of coordinates; of all points of the rim's triangle (⅓, ⅓, ⅓) is farthest.
  TriangleMesh pit{Points(4, 3), Triangles(3, 3)};
  pit.positions << 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0;
  const TriangleMesh lid = triangle(pit.position(0), pit.position(1), pit.position(2));
  const VertexDistances on_rim = {Eigen::VectorXd::Zero(3), {0, 1, 2}};
  const FarthestPoint known = {.point = pit.position(0), .distance = 0};
  Triangles foot_first(3, 3), foot_last(3, 3);
  foot_first << 3, 0, 1, 3, 1, 2, 3, 2, 0;
  foot_last << 0, 1, 3, 1, 2, 3, 2, 0, 3;
  for (const Triangles& walls : {foot_first, foot_last}) {
    pit.triangles = walls;
    const FarthestPoint found = find_farthest(lid, on_rim, pit, RayScene(pit), known, 0, 1);
    CHECK((found.point - Vector3::Constant(1.0 / 3)).norm() < 1e-15);
    CHECK(found.distance == Approx(1.0 / 3).epsilon(1e-15));
    CHECK(found.at_most <= found.distance * (1 + 1e-15));
  }
}

TEST_CASE("farthest point: of more triangles than are looked into, those that promise most are") {
  // Everything is 10 away. Two corners of a small triangle promise no more than √(10² + 2) over one
  // another's faces; those of a large one 18, and it is the last.
  TriangleMesh above = grid(91, 0, 10);
  above.triangles.conservativeResize(above.face_count() + 1, 3);
  above.triangles.bottomRows(1) << 0, 15, 15 * 92;
  const FarthestPoint found = farthest(above, grid(92, -0.5, 0));
  CHECK(found.distance == 10);
  CHECK(found.at_most > 10);  // not all that may be farther was cut
  CHECK(found.at_most <= std::sqrt(102));
}

TEST_CASE("farthest point: the bound holds and narrows down, on any pair of surfaces") {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const TriangleMesh crumpled = random_sphere_mesh(60, seed), ball = icosphere(2);
    const RayScene scene(ball);
    const FarthestPoint found = farthest(crumpled, ball);
    CHECK(found.distance <= found.at_most);
    CHECK(found.at_most <= 1.0011 * found.distance);
    CHECK(std::sqrt(scene.nearest(found.point).squared_distance) == found.distance);
    for (int f = 0; f < crumpled.face_count(); ++f) {
      Vector3 middle = Vector3::Zero();
      for (int k = 0; k < 3; ++k) middle += crumpled.position(crumpled.triangles(f, k)) / 3;
      CHECK(std::sqrt(scene.nearest(middle).squared_distance) <= found.at_most);
    }
  }
}

TEST_CASE("farthest point: what is known already is kept where nothing is farther") {
  const TriangleMesh ball = icosphere(1);
  const FarthestPoint known = {.point = {9, 9, 9}, .distance = 100};
  const FarthestPoint found = farthest(ball, ball, known);
  CHECK(found.distance == 100);
  CHECK(found.point == known.point);
  CHECK(found.at_most == 100);
}

TEST_CASE(
    "farthest point: the bound is within twice of what is found where triangles run from end to "
    "end") {
  // Sheaves of needles: as many triangles as may be looked into at first, each with a large bound.
  const int around = 6000;
  TriangleMesh thin = tube(2, around), other = tube(3, around);
  thin.positions.leftCols<2>() *= 1e-2;
  other.positions.leftCols<2>() *= 1e-2;
  other.positions.col(2) *= 2.0 / 3;
  other.positions.col(0).array() += 1e-3;
  const FarthestPoint found = farthest(thin, other);
  CHECK(found.distance > 5e-4);
  CHECK(found.distance < 1e-2);
  CHECK(found.at_most <= 2 * found.distance);
}

TEST_CASE("farthest point: of thin bodies of different triangles, the bound is as near") {
  // Needles from end to end, almost in place of one another: halved, they promised a thousand times
  // what there is after hundreds of cuts each.
  TriangleMesh thin = tube(4, 900), other = tube(3, 1100);
  other.positions.col(2) *= 3.0 / 2;
  for (TriangleMesh* mesh : {&thin, &other}) {
    mesh->positions.row(0).z() = 2.25;
    mesh->positions.row(mesh->vertex_count() - 1).z() = -2.25;
    mesh->positions.leftCols<2>() *= 1e-3;
  }
  const FarthestPoint found = farthest(thin, other, {}, 20 * thin.face_count());
  CHECK(found.distance < 1e-7);
  CHECK(found.at_most <= 2 * found.distance);
}

TEST_CASE("farthest point: a brush beside one of other triangles, in few cuts each") {
  const TriangleMesh few = hedgehog(50, 8, 1), many = hedgehog(50, 12, 4);
  const FarthestPoint found = farthest(few, many, {}, 25 * few.face_count());
  CHECK(found.distance < 1e-2);
  CHECK(found.at_most <= 2 * found.distance);
}

}  // namespace sphparam
