#include <catch2/catch.hpp>
#include <numbers>

#include "sphparam/baselines/brechbuehler.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/distortion.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("brechbuehler: latitude is harmonic, and rises along the date line") {
  for (const TriangleMesh& mesh : {icosphere(3), tube(20, 8), random_sphere_mesh(200, 4)}) {
    const Topology topology(mesh);
    const Vertex north = 0;
    Vertex south = static_cast<Vertex>(mesh.vertex_count()) - 1;
    while (topology.find_halfedge(north, south) >= 0) --south;
    const auto map = conduct_heat(topology, north, south);
    REQUIRE(map);
    CHECK(map->latitude[north] == 0);
    CHECK(map->latitude[south] == std::numbers::pi);
    for (Vertex v = 0; v < topology.vertex_count(); ++v) {
      if (v == north || v == south) continue;
      double flux = 0;
      topology.for_each_outgoing(
          v, [&](Halfedge h) { flux += map->latitude[topology.target(h)] - map->latitude[v]; });
      CHECK(std::abs(flux) < 1e-10);
    }
    REQUIRE(map->date_line.front() == north);
    REQUIRE(map->date_line.back() == south);
    for (size_t k = 1; k < map->date_line.size(); ++k) {
      CHECK(map->latitude[map->date_line[k]] > map->latitude[map->date_line[k - 1]]);
    }
  }
}

TEST_CASE("brechbuehler: longitude grows by one turn around each pole, seen from outside") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const Vertex north = 3, south = 600;
  const auto map = conduct_heat(topology, north, south);
  REQUIRE(map);
  const auto winding =
      [&](Vertex pole) {  // of the link, counter-clockwise; steps below half a turn
        double sum = 0;
        topology.for_each_outgoing(pole, [&](Halfedge h) {
          const double step = map->longitude[topology.apex(h)] - map->longitude[topology.target(h)];
          sum += std::remainder(step, 2 * std::numbers::pi);
        });
        return sum / (2 * std::numbers::pi);
      };
  CHECK(winding(north) == Approx(1));
  CHECK(winding(south) == Approx(-1));
}

TEST_CASE("brechbuehler: there is no longitude between neighbours") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  CHECK_FALSE(conduct_heat(topology, 5, 5));
  CHECK_THROWS_WITH(conduct_heat(topology, 5, topology.vertex_count()),
                    Catch::Contains("south") && Catch::Contains("162"));
  CHECK_THROWS_WITH(conduct_heat(topology, -1, 5), Catch::Contains("north"));
  CHECK_FALSE(conduct_heat(topology, topology.origin(9), topology.target(9)));
  const BaselineResult result = map_brechbuehler(
      mesh, topology, {.poles = std::pair(topology.origin(9), topology.target(9))});
  CHECK(result.end == BaselineEnd::NoResult);
  CHECK(result.statement.find("adjacent") != std::string::npos);
}

TEST_CASE("brechbuehler: the optimisation lowers the area error and adds no fold") {
  for (const TriangleMesh& mesh : {icosphere(3), tube(12, 12), uv_sphere(24, 11)}) {
    const Topology topology(mesh);
    const BaselineResult before = map_brechbuehler(mesh, topology, {.max_steps = 0});
    const BaselineResult after = map_brechbuehler(mesh, topology);
    REQUIRE(before.map);
    REQUIRE(after.map);
    const auto error = [&](const BaselineResult& result) {
      return summarise(measure_distortion(mesh, *result.map)).weighted_abs_log2_area;
    };
    CHECK(error(after) < error(before));
    CHECK(certify(topology, *after.map).fold_count() <=
          certify(topology, *before.map).fold_count());
  }
}
