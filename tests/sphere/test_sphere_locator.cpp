#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <type_traits>

#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/sphere_locator.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

using Rational = boost::multiprecision::cpp_rational;

// A locator keeps references: to nothing that ends with the expression.
static_assert(std::is_constructible_v<SphereLocator, Topology&, const SphereMap&>);
static_assert(!std::is_constructible_v<SphereLocator, Topology, const SphereMap&>);
static_assert(!std::is_constructible_v<SphereLocator, const Topology&, SphereMap>);
static_assert(!std::is_constructible_v<SphereLocator, Topology, SphereMap, int>);

/// The sign of det(a, b, q) by other means than the library's.
int sign_of_det(const Vector3& a, const Vector3& b, const Vector3& q) {
  const auto r = [](double x) { return Rational(x); };
  const Rational det = r(q[0]) * (r(a[1]) * r(b[2]) - r(a[2]) * r(b[1])) +
                       r(q[1]) * (r(a[2]) * r(b[0]) - r(a[0]) * r(b[2])) +
                       r(q[2]) * (r(a[0]) * r(b[1]) - r(a[1]) * r(b[0]));
  return det.sign();
}

bool holds(const Topology& topology, const SphereMap& map, Face f, const Vector3& q) {
  for (int k = 0; k < 3; ++k) {
    const Halfedge h = 3 * f + k;
    if (sign_of_det(map.point(topology.origin(h)), map.point(topology.target(h)), q) < 0) {
      return false;
    }
  }
  return true;
}

Points random_directions(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Points q(count, 3);
  for (int i = 0; i < count; ++i)
    q.row(i) = Vector3(normal(random), normal(random), normal(random));
  return q;
}

/// Everything drawn together at ±x by a linear map, which folds nothing.
SphereMap squashed(SphereMap map, double factor) {
  map.points.rightCols(2) *= factor;
  map.points.rowwise().normalize();
  return map;
}

struct Mapped {
  TriangleMesh mesh;
  Topology topology;
  SphereMap map;
  explicit Mapped(TriangleMesh m)
      : mesh(std::move(m)), topology(mesh), map(parameterize(mesh, {.threads = 1}).map) {}
};

}  // namespace

TEST_CASE("SphereLocator: the face holds the direction, and is the lowest that does") {
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), random_sphere_mesh(60, 5)}) {
    const Mapped m(mesh);
    const SphereLocator locator(m.topology, m.map);
    const Points directions = random_directions(200, 1);
    for (int i = 0; i < directions.rows(); ++i) {
      const Vector3 q = directions.row(i);
      Face lowest = 0;
      while (!holds(m.topology, m.map, lowest, q)) ++lowest;
      CHECK(locator.locate(q).face == lowest);
    }
  }
}

TEST_CASE("SphereLocator: ties at vertices and on edges go to the face of lowest index") {
  const TriangleMesh mesh = octahedron();  // its edges lie in the coordinate planes: exact ties
  const Topology topology(mesh);
  const SphereMap map{mesh.positions};
  const SphereLocator locator(topology, map);
  for (double x : {-2.0, 0.0, 3.0}) {
    for (double y : {-1.0, 0.0, 7.0}) {
      for (double z : {-5.0, 0.0, 0.5}) {
        const Vector3 q(x, y, z);
        if (q.isZero()) continue;
        Face lowest = 0;
        while (!holds(topology, map, lowest, q)) ++lowest;
        const SurfacePoint found = locator.locate(q);
        CHECK(found.face == lowest);
        for (int k = 0; k < 3; ++k) {
          const Halfedge h = 3 * found.face + (k + 1) % 3;
          const int s =
              sign_of_det(map.point(topology.origin(h)), map.point(topology.target(h)), q);
          CHECK((found.barycentric[k] == 0) == (s == 0));
        }
      }
    }
  }
}

TEST_CASE("SphereLocator: the weights give the direction back, in tiny triangles too") {
  const Mapped m(icosphere(4));
  for (const double factor : {1.0, 1e-4, 1e-7}) {
    const SphereMap map = squashed(m.map, factor);
    REQUIRE(certify(m.topology, map).bijective());
    const SphereLocator locator(m.topology, map);
    for (Face f = 0; f < m.topology.face_count(); f += 7) {
      const Vector3 weights(0.2, 0.3, 0.5);
      Vector3 q = Vector3::Zero();
      for (int k = 0; k < 3; ++k) q += weights[k] * map.point(m.topology.vertex(f, k));
      const SurfacePoint found = locator.locate(q);
      CHECK(found.face == f);
      CHECK((found.barycentric - weights).norm() < 1e-6);
      CHECK(found.barycentric.sum() == Approx(1).epsilon(1e-15));
    }
  }
}

TEST_CASE("SphereLocator: a vertex's own ray is found at that vertex, with weight one") {
  const Mapped m(random_sphere_mesh(400, 9));
  const SphereLocator locator(m.topology, m.map);
  for (Vertex v = 0; v < m.topology.vertex_count(); ++v) {
    const SurfacePoint found = locator.locate(m.map.point(v));
    int corner = 0;
    CHECK(found.barycentric.maxCoeff(&corner) == 1);
    CHECK(m.topology.vertex(found.face, corner) == v);
  }
}

TEST_CASE("SphereLocator: all at once is one by one, in any order, with any number of threads") {
  const Mapped m(tube(60, 7));
  const SphereLocator locator(m.topology, m.map);
  Points q = random_directions(5000, 3);
  for (int i = 2500; i < 5000; ++i) q.row(i) = Vector3(std::cos(i * 1e-3), std::sin(i * 1e-3), 0.1);
  const auto all = locator.locate_all(q, 1), again = locator.locate_all(q, 3);
  for (int i = 0; i < 5000; ++i) {
    const SurfacePoint one = locator.locate(q.row(i));
    const auto at = static_cast<size_t>(i);
    REQUIRE(one.face == all[at].face);
    REQUIRE(one.barycentric == all[at].barycentric);
    REQUIRE(one.barycentric == again[at].barycentric);
  }
}

TEST_CASE("SphereLocator: rows near one another are found as one by one, in tiny triangles too") {
  const Mapped m(icosphere(4));
  for (const double factor : {1.0, 1e-4, 1e-7}) {
    const SphereMap map = squashed(m.map, factor);
    const SphereLocator locator(m.topology, map);
    Points q(2003, 3);  // round the great circle that the tiny triangles lie on; vertices
    for (int i = 0; i < 2003; ++i) {
      q.row(i) = Vector3(std::cos(i * 3e-3), factor * std::sin(i * 3e-3), 0.1 * factor);
      if (i % 50 == 0) q.row(i) = map.point(i);
    }
    const auto all = locator.locate_all(q, 2);
    for (int i = 0; i < 2003; ++i) {
      const SurfacePoint one = locator.locate(q.row(i));
      REQUIRE(one.face == all[static_cast<size_t>(i)].face);
      REQUIRE(one.barycentric == all[static_cast<size_t>(i)].barycentric);
    }
  }
}

TEST_CASE("SphereLocator: length does not matter, what is no direction is refused") {
  const Mapped m(icosphere(2));
  const SphereLocator locator(m.topology, m.map);
  const Vector3 q(0.3, -0.4, 0.5);
  const SurfacePoint found = locator.locate(q);
  for (const int exponent : {-1000, -300, 300, 900}) {
    const Vector3 scaled = q.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    CHECK(locator.locate(scaled).face == found.face);
  }
  CHECK_THROWS_AS(locator.locate(Vector3::Zero()), std::invalid_argument);
  CHECK_THROWS_AS(locator.locate(Vector3(0, std::nan(""), 1)), std::invalid_argument);
  CHECK_THROWS_AS(locator.locate(Vector3(0, std::numeric_limits<double>::infinity(), 1)),
                  std::invalid_argument);
  const SphereMap of_three{m.map.points.topRows(3)};
  CHECK_THROWS_AS(SphereLocator(m.topology, of_three), std::invalid_argument);
}
