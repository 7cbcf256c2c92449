#include <catch2/catch.hpp>

#include "embedding/constructions/grid_lift.h"
#include "sphparam/sphere/certificate.h"
#include "support/all_triangulations.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("grid_lift: certified for every triangulation up to 10 vertices, before relaxation too") {
  int failures = 0;
  for (int vertices = 4; vertices <= 10; ++vertices) {
    for (const Rotations& rotations : all_triangulations(vertices)) {
      const TriangleMesh mesh = mesh_of(rotations, 1);
      const Topology topology(mesh);
      for (const int sweeps : {0, 3}) {
        const GridLift lift = grid_lift(mesh, topology, {.sweeps = sweeps, .threads = 1});
        failures += !lift.bijective || lift.report.attempts != 1 || !lift.report.unit ||
                    !certify(topology, lift.map, 1).bijective();
      }
    }
  }
  CHECK(failures == 0);
}

TEST_CASE("grid_lift: the mesh's own vertices and faces, at unit length") {
  const TriangleMesh mesh = random_sphere_mesh(3000, 2);
  const Topology topology(mesh);
  const GridLift lift = grid_lift(mesh, topology);
  REQUIRE(lift.bijective);
  CHECK(lift.map.points.rows() == mesh.vertex_count());
  const Certificate certificate = certify(topology, lift.map);
  CHECK(certificate.bijective());
  CHECK(certificate.max_length_error < 1e-15);
}

TEST_CASE("grid_lift: shapes that leave doubles no room elsewhere") {
  TriangleMesh collapsed = random_sphere_mesh(2000, 8);
  collapsed.positions.setZero();
  TriangleMesh line = icosphere(3);
  line.positions.rightCols(2).setZero();
  for (const TriangleMesh& mesh : {tube(20000, 3), uv_sphere(20000, 1), collapsed, line}) {
    const Topology topology(mesh);
    const GridLift lift = grid_lift(mesh, topology, {.sweeps = 2});
    CHECK(lift.bijective);
    CHECK(certify(topology, lift.map).bijective());
  }
}

TEST_CASE("grid_lift: leaves out a vertex of valence five or less, the one with most area around") {
  TriangleMesh mesh = icosphere(3);  // twelve vertices of valence five
  const Topology topology(mesh);
  topology.for_each_outgoing(7, [&](Halfedge h) {
    mesh.positions.row(topology.target(h)) += 0.5 * mesh.positions.row(7);
  });
  const GridLift lift = grid_lift(mesh, topology, {.sweeps = 0});
  CHECK(topology.valence(lift.report.south) <= 5);
  CHECK(lift.report.south == 7);
}

TEST_CASE("grid_lift: relaxation lowers the energy, and keeps the map one-to-one") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const auto energy = [&](int sweeps) {
    return distortion_energy(topology, source, grid_lift(mesh, topology, {.sweeps = sweeps}).map,
                             {});
  };
  CHECK(energy(20) < 0.9 * energy(0));
}

TEST_CASE("grid_lift: the same bytes for 1, 2 and 4 threads") {
  const TriangleMesh mesh = random_sphere_mesh(20000, 4);
  const Topology topology(mesh);
  const Points one = grid_lift(mesh, topology, {.threads = 1}).map.points;
  for (const int threads : {2, 4}) {
    CHECK(grid_lift(mesh, topology, {.threads = threads}).map.points == one);
  }
}
