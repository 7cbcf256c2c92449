#include <algorithm>
#include <catch2/catch.hpp>

#include "curvilinear/cut_sphere.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Detail::Approx;

namespace {

int link_vertices_on_path(const Topology& topology, Vertex pole, const DateLine& date_line) {
  int count = 0;
  topology.for_each_outgoing(pole, [&](Halfedge h) {
    count += static_cast<int>(
        std::count(date_line.path.begin(), date_line.path.end(), topology.target(h)));
  });
  return count;
}

double length(const TriangleMesh& mesh, const DateLine& date_line) {
  double sum = 0;
  for (size_t i = 1; i < date_line.path.size(); ++i) {
    sum += (mesh.position(date_line.path[i]) - mesh.position(date_line.path[i - 1])).norm();
  }
  return sum;
}

}  // namespace

TEST_CASE("date_line: the shortest path between the poles of a globe is a meridian") {
  const TriangleMesh mesh = uv_sphere(16, 9);
  const Topology topology(mesh);
  const DateLine date_line = shortest_date_line(mesh, topology, {0, topology.vertex_count() - 1});
  REQUIRE(date_line.path.size() == 11);
  for (size_t i = 2; i + 1 < date_line.path.size(); ++i) {
    const Vector3 a = mesh.position(date_line.path[1]), b = mesh.position(date_line.path[i]);
    CHECK(std::abs(a.x() * b.y() - a.y() * b.x()) < 1e-12);
    CHECK(a.x() * b.x() + a.y() * b.y() > 0);
  }
}

TEST_CASE("date_line: no other path is shorter") {
  const TriangleMesh mesh = random_sphere_mesh(300, 6);
  const Topology topology(mesh);
  const Poles poles = choose_poles(mesh, topology).value();
  const DateLine date_line = shortest_date_line(mesh, topology, poles);
  // Bellman's condition from both ends: d(v) ≤ d(u) + |uv| with d the distance from the south pole,
  // and the path's length is d(north).
  std::vector<double> d(static_cast<size_t>(topology.vertex_count()), 1e300);
  d[static_cast<size_t>(poles.south)] = 0;
  for (int round = 0; round < topology.vertex_count(); ++round) {
    for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
      const Vertex a = topology.origin(h), b = topology.target(h);
      d[static_cast<size_t>(b)] =
          std::min(d[static_cast<size_t>(b)],
                   d[static_cast<size_t>(a)] + (mesh.position(a) - mesh.position(b)).norm());
    }
  }
  CHECK(length(mesh, date_line) == Approx(d[static_cast<size_t>(poles.north)]).epsilon(1e-12));
}

TEST_CASE("date_line: an induced date line has no chord and touches each link once") {
  for (const TriangleMesh& mesh : various_spheres()) {
    const Topology topology(mesh);
    const Poles poles = choose_poles(mesh, topology).value();
    const DateLine shortest = shortest_date_line(mesh, topology, poles);
    const DateLine induced = induced_date_line(topology, shortest);
    CHECK(is_induced(topology, induced));
    CHECK(induced.path.front() == poles.north);
    CHECK(induced.path.back() == poles.south);
    CHECK(link_vertices_on_path(topology, poles.north, induced) == 1);
    CHECK(link_vertices_on_path(topology, poles.south, induced) == 1);
    CHECK(induced.path.size() <= shortest.path.size());
  }
}

TEST_CASE("date_line: a detour around a triangle is a chord, and is cut short") {
  const TriangleMesh mesh = uv_sphere(16, 9);
  const Topology topology(mesh);
  const DateLine meridian = shortest_date_line(mesh, topology, {0, topology.vertex_count() - 1});
  CHECK(is_induced(topology, meridian));
  DateLine detour = meridian;
  const Halfedge h = topology.find_halfedge(meridian.path[4], meridian.path[5]);
  detour.path.insert(detour.path.begin() + 5, topology.apex(h));
  CHECK_FALSE(is_induced(topology, detour));
  CHECK(induced_date_line(topology, detour).path == meridian.path);
  DateLine gap = meridian;
  gap.path.erase(gap.path.begin() + 4);
  CHECK_FALSE(is_induced(topology, gap));
}

TEST_CASE("date_line: where going along a link is as short, the spoke is taken") {
  // All edges of no length at all: every path is a shortest one.
  TriangleMesh mesh = uv_sphere(12, 6);
  const Topology topology(mesh);
  mesh.positions.setZero();
  const Poles poles{0, topology.vertex_count() - 1};
  const DateLine date_line = shortest_date_line(mesh, topology, poles);
  CHECK(link_vertices_on_path(topology, poles.north, date_line) == 1);
  CHECK(link_vertices_on_path(topology, poles.south, date_line) == 1);
}
