#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "correspondence/end_pairings.h"
#include "correspondence/extremities.h"
#include "correspondence/surface_roads.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

const std::array<Vertex, 4> tips = {0, 3, 5, 8};  // of an icosphere, no two of them opposite

/// A ball with four arms of different lengths.
TriangleMesh four_arms(int level) {
  TriangleMesh mesh = icosphere(level);
  const TriangleMesh ball = mesh;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    double length = 2;
    for (const Vertex tip : tips) {
      const Vector3 axis = ball.position(tip);
      const double near = std::exp(-30 * (ball.position(v) - axis).squaredNorm());
      mesh.positions.row(v) += length * near * axis;
      length += 0.4;
    }
  }
  return mesh;
}

Extremities ends_of(const TriangleMesh& mesh, int most = 7, int threads = 0) {
  return find_extremities(mesh, Topology(mesh), most, threads);
}

}  // namespace

TEST_CASE("roads: on a ball a great circle within 8 %, never less than the chord") {
  const TriangleMesh ball = icosphere(4);
  const SurfaceRoads roads(ball, Topology(ball));
  const std::vector<double> lengths = roads.distances(0);
  for (Vertex v = 0; v < ball.vertex_count(); ++v) {
    const double chord = (ball.position(v) - ball.position(0)).norm();
    const double arc = 2 * std::asin(std::min(1.0, chord / 2));
    CHECK(lengths[static_cast<size_t>(v)] >= chord * (1 - 1e-12));
    CHECK(lengths[static_cast<size_t>(v)] == Approx(arc).epsilon(0.08).margin(1e-12));
  }
}

TEST_CASE("ends: the tips of arms, the longest the most prominent, and their distances") {
  const TriangleMesh mesh = four_arms(4);
  const Extremities ends = ends_of(mesh);
  REQUIRE(ends.vertices.size() == 4);
  CHECK(ends.vertices.front() == tips.back());
  for (const Vertex tip : tips) CHECK(std::ranges::count(ends.vertices, tip) == 1);
  for (Eigen::Index i = 0; i < 4; ++i) {
    CHECK(ends.distances(i, i) == 0);
    for (Eigen::Index j = 0; j < i; ++j) {
      CHECK(ends.distances(i, j) == Approx(ends.distances(j, i)));
      CHECK(ends.distances(i, j) > 0.9);
    }
  }
}

TEST_CASE("ends: a size and a place do not matter, a ball has at most one") {
  const TriangleMesh mesh = four_arms(4);
  TriangleMesh other = mesh;
  other.positions = (mesh.positions * 8).rowwise() + Vector3(64, -32, 16).transpose();
  const Extremities a = ends_of(mesh), b = ends_of(other);
  CHECK(a.vertices == b.vertices);
  CHECK((a.farness - b.farness).norm() < 0.01);
  CHECK(ends_of(icosphere(4)).vertices.size() <= 1);
}

TEST_CASE("ends: no more than are asked for, the same for any number of threads") {
  const TriangleMesh mesh = four_arms(4);
  CHECK(ends_of(mesh, 3).vertices.size() == 3);
  CHECK(ends_of(mesh, 7, 1).distances == ends_of(mesh, 7, 3).distances);
}

TEST_CASE("pairings: of a surface with itself the first is the identity, without cost") {
  const Extremities ends = ends_of(four_arms(4));
  const std::vector<EndPairing> pairings = likely_pairings(ends, ends, 5);
  REQUIRE(pairings.size() == 5);
  CHECK(pairings[0].cost < 1e-12);
  REQUIRE(pairings[0].pairs.size() == 4);
  for (const auto& [a, b] : pairings[0].pairs) CHECK(a == b);
  for (size_t i = 1; i < pairings.size(); ++i) CHECK(pairings[i].cost >= pairings[i - 1].cost);
}

TEST_CASE("pairings: none of fewer than three ends") {
  const Extremities ends = ends_of(four_arms(4)), few = ends_of(four_arms(4), 2);
  CHECK(likely_pairings(ends, few, 5).empty());
}

}  // namespace sphparam::tests
