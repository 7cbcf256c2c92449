#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "remesh/seams.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("seams: where a vertex has two values in one chart a face has that of its own side") {
  // A slit along two edges through a vertex: beyond its ends the chart goes around it.
  const TriangleMesh ball = icosphere(2);
  const Topology topology(ball);
  const SphereMap map{ball.positions};
  const SphereLocator locator(topology, map);
  const Vertex v = 50;
  std::vector<Halfedge> ring;
  topology.for_each_outgoing(v, [&](Halfedge h) { ring.push_back(h); });
  REQUIRE(ring.size() == 6);
  std::vector<double> values(static_cast<size_t>(3 * topology.face_count()), 0.0);
  for (size_t i = 0; i < 3; ++i) values[static_cast<size_t>(ring[i])] = 1;
  const Seams seams(topology, locator, values.data(), 1);
  CHECK(seams.chart_count() == 1);
  std::array<int, 3> corners{};
  for (size_t i = 0; i < 6; ++i) {
    const Face home = Topology::face(ring[i]);
    ++corners[static_cast<size_t>(ring[i] % 3)];
    const Vector3 inside(1.0 / 3, 1.0 / 3, 1.0 / 3);
    const Vector3 direction =
        (map.point(topology.vertex(home, 0)) + map.point(topology.vertex(home, 1)) +
         map.point(topology.vertex(home, 2)))
            .normalized();
    for (const Halfedge other : ring) {
      SurfacePoint at{Topology::face(other), Vector3::Zero()};
      at.barycentric[other % 3] = 1;
      double value = -1;
      seams.evaluate({direction, {home, inside}}, map.point(v), at, &value);
      CHECK(value == (i < 3 ? 1 : 0));
    }
  }
  for (const int count : corners) CHECK(count > 0);  // it is every corner of some face
}

TEST_CASE("seams: a corner beyond the end of a chart has what that end has") {
  // Two charts, east and west; east has x + 10.
  const TriangleMesh ball = icosphere(3);
  const Topology topology(ball);
  const SphereMap map{ball.positions};
  const SphereLocator locator(topology, map);
  std::vector<double> values;
  const auto is_east = [&](Face f) {
    return map.point(topology.vertex(f, 0)).x() + map.point(topology.vertex(f, 1)).x() +
               map.point(topology.vertex(f, 2)).x() >
           0;
  };
  for (Face f = 0; f < topology.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      values.push_back(map.point(topology.vertex(f, k)).x() + (is_east(f) ? 10 : 0));
  const Seams seams(topology, locator, values.data(), 1);
  CHECK(seams.chart_count() == 2);
  const Vector3 east = Vector3(0.3, 0.1, 0.95).normalized(),
                west = Vector3(-0.3, 0.1, 0.95).normalized();
  const auto value = [&](const Vector3& middle, const Vector3& corner) {
    double result = 0;
    seams.evaluate({middle, locator.locate(middle)}, corner, locator.locate(corner), &result);
    return result;
  };
  CHECK(value(east, east) == Approx(10.3).margin(0.02));
  CHECK(value(west, west) == Approx(-0.3).margin(0.02));
  CHECK(value(east, west) == Approx(10).margin(0.1));
  CHECK(value(west, east) == Approx(0).margin(0.1));
}
