#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "sphparam/baselines/hemispheres.h"
#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// V − E + F of the closed faces of one side.
long euler_characteristic(const Topology& topology, const Bisection& bisection, char side) {
  std::set<Vertex> vertices;
  long faces = 0, halfedges = 0, rim = 0;
  for (Face f = 0; f < topology.face_count(); ++f) {
    if (bisection.side[static_cast<size_t>(f)] != side) continue;
    ++faces;
    for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
      vertices.insert(topology.origin(h));
      ++halfedges;
      rim += bisection.side[static_cast<size_t>(Topology::face(topology.twin(h)))] != side;
    }
  }
  return static_cast<long>(vertices.size()) - (halfedges + rim) / 2 + faces;
}

}  // namespace

TEST_CASE("hemispheres: the halves are balanced disks, the seam their simple common boundary") {
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), icosphere(3), tube(40, 6),
                                   uv_sphere(200, 1), random_sphere_mesh(500, 1)}) {
    const Topology topology(mesh);
    const Bisection bisection = bisect(mesh, topology);
    const long ones = std::count(bisection.side.begin(), bisection.side.end(), 1);
    CHECK(ones == mesh.face_count() / 2);
    CHECK(euler_characteristic(topology, bisection, 0) == 1);
    CHECK(euler_characteristic(topology, bisection, 1) == 1);
    const std::vector<Vertex>& seam = bisection.seam;
    CHECK(std::set<Vertex>(seam.begin(), seam.end()).size() == seam.size());
    long rim = 0;
    for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
      rim += bisection.side[static_cast<size_t>(Topology::face(h))] == 0 &&
             bisection.side[static_cast<size_t>(Topology::face(topology.twin(h)))] == 1;
    }
    CHECK(rim == static_cast<long>(seam.size()));
    for (size_t k = 0; k < seam.size(); ++k) {
      const Halfedge h = topology.find_halfedge(seam[k], seam[(k + 1) % seam.size()]);
      REQUIRE(h >= 0);
      CHECK(bisection.side[static_cast<size_t>(Topology::face(h))] == 0);  // on its left
    }
  }
}

TEST_CASE("hemispheres: each half is placed on its side of the equator, the seam on it") {
  const TriangleMesh mesh = tube(20, 12);
  const Topology topology(mesh);
  const Bisection bisection = bisect(mesh, topology);
  const SphereMap map = place_hemispheres(mesh, topology, bisection);
  const std::set<Vertex> seam(bisection.seam.begin(), bisection.seam.end());
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const double z = map.point(topology.origin(h)).z();
    if (seam.contains(topology.origin(h))) {
      CHECK(std::abs(z) < 1e-15);
    } else {
      CHECK((z > 0) == (bisection.side[static_cast<size_t>(Topology::face(h))] == 0));
    }
  }
  CHECK(certify(topology, map).covering > 0.9);  // seen from outside, as the mesh is
}

TEST_CASE("hemispheres: Tutte's equations are solved, and the solution is one-to-one") {
  for (const TriangleMesh& mesh : {icosphere(3), tube(10, 12), uv_sphere(20, 15)}) {
    const Topology topology(mesh);
    const BaselineResult result = map_hemispheres(mesh, topology);
    INFO(result.statement);
    CHECK(result.end == BaselineEnd::Converged);
    CHECK(certify(topology, *result.map).bijective());
  }
}

TEST_CASE("hemispheres: equations without weights have no solution, and none is told") {
  TriangleMesh mesh = icosphere(1);
  mesh.positions.setOnes();
  const BaselineResult result =
      map_hemispheres(mesh, Topology(mesh), {.weights = WeightKind::Cotangent});
  CHECK(result.end == BaselineEnd::NoResult);
  CHECK(result.statement.find("the factorisation failed") != std::string::npos);
}

TEST_CASE("hemispheres: a solution stays where it is, sweeps or not") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const BaselineResult none = map_hemispheres(mesh, topology, {.max_sweeps = 0});
  const BaselineResult many = map_hemispheres(mesh, topology, {.max_sweeps = 200});
  CHECK(none.end == BaselineEnd::Converged);
  CHECK(many.end == BaselineEnd::Converged);
  CHECK(none.stages[2].iterations == 0);
  CHECK(many.stages[2].iterations > 0);
  // The same up to a Möbius transformation: cross-ratios of chords agree.
  const auto cross_ratio = [](const SphereMap& map, Vertex a, Vertex b, Vertex c, Vertex d) {
    const auto chord = [&](Vertex p, Vertex q) { return (map.point(p) - map.point(q)).norm(); };
    return chord(a, b) * chord(c, d) / (chord(a, c) * chord(b, d));
  };
  for (Vertex v = 20; v + 30 < mesh.vertex_count(); v += 7) {
    CHECK(cross_ratio(*none.map, 0, 5, v, v + 30) ==
          Approx(cross_ratio(*many.map, 0, 5, v, v + 30)).epsilon(0.02));
  }
}
