#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sphere/row_locator.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

DirectionTable row_at(double phi, size_t count) {
  DirectionTable directions(count);
  for (size_t c = 0; c < count; ++c) {
    const double theta =
        2 * std::numbers::pi * (static_cast<double>(c) + 0.5) / static_cast<double>(count);
    directions.x[0][c] = std::cos(theta) * std::sin(phi);
    directions.x[1][c] = std::sin(theta) * std::sin(phi);
    directions.x[2][c] = std::cos(phi);
  }
  return directions;
}

void require_as_alone(const SphereLocator& locator, const DirectionTable& directions) {
  PointTable points(directions.count);
  RowLocator(locator).locate(directions, points);
  for (size_t c = 0; c < directions.count; ++c) {
    const SurfacePoint alone = locator.locate(directions[c]), point = points[c];
    INFO("column " << c);
    REQUIRE(point.face == alone.face);
    REQUIRE((point.barycentric - alone.barycentric).norm() < 1e-15);
    for (int k = 0; k < 3; ++k) REQUIRE((point.barycentric[k] == 0) == (alone.barycentric[k] == 0));
  }
}

}  // namespace

TEST_CASE("row locator: rows finer than triangles and coarser are located as one by one") {
  const TriangleMesh mesh = tests::icosphere(4);
  const Topology topology(mesh);
  const SphereMap map{mesh.positions};
  const SphereLocator locator(topology, map);
  for (const size_t count : {1, 2, 7, 8, 9, 31, 400, 3001}) {
    for (double phi = 0.01; phi < std::numbers::pi; phi += 0.1)
      require_as_alone(locator, row_at(phi, count));
  }
}

TEST_CASE("row locator: along edges and through vertices the face of lowest index is told") {
  const TriangleMesh mesh = tests::icosphere(2);
  const Topology topology(mesh);
  const SphereMap map{mesh.positions};
  const SphereLocator locator(topology, map);
  DirectionTable directions(201);
  for (const Halfedge h : {0, 100, 301}) {
    const Vector3 a = map.point(topology.origin(h)), b = map.point(topology.target(h));
    for (size_t i = 0; i < directions.count; ++i) {
      const double share = static_cast<double>(i) / 100;  // to b, and on into the next face
      const Vector3 q = (1 - share) * a + share * b;
      for (size_t k = 0; k < 3; ++k) directions.x[k][i] = q[static_cast<int>(k)];
    }
    require_as_alone(locator, directions);
  }
}

TEST_CASE("row locator: directions of any length but none") {
  const TriangleMesh mesh = tests::icosphere(2);
  const Topology topology(mesh);
  const SphereMap map{mesh.positions};
  const SphereLocator locator(topology, map);
  DirectionTable directions = row_at(1.2, 500);
  for (size_t c = 0; c < directions.count; ++c) {
    const double length = c % 5 == 0 ? 1e-200 : c % 7 == 0 ? 1e150 : 1;
    for (auto& component : directions.x) component[c] *= length;
  }
  require_as_alone(locator, directions);
  directions.x[0][9] = directions.x[1][9] = directions.x[2][9] = 0;
  PointTable points(directions.count);
  CHECK_THROWS_AS(RowLocator(locator).locate(directions, points), std::invalid_argument);
}
