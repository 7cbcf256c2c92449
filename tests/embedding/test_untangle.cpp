#include <catch2/catch.hpp>

#include "embedding/constructions/untangle.h"
#include "folded_maps.h"
#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("untangle: repairs swapped vertices and leaves everything far from them alone") {
  for (const TriangleMesh& mesh : {icosphere(4), uv_sphere(48, 24), uv_sphere(500, 5)}) {
    const Topology topology(mesh);
    const RestTriangles source = measure_source(mesh);
    for (unsigned seed = 0; seed < 10; ++seed) {
      const SphereMap folded = with_swaps(topology, radial_map(mesh), 8, seed);
      const Untangled r = untangle(topology, source, folded);
      CHECK(r.report.folds_before == static_cast<long>(folded_faces(topology, folded).size()));
      CHECK(r.report.folds_after == 0);
      CHECK(certify(topology, r.map).bijective());
      long touched = 0;
      for (Vertex v = 0; v < topology.vertex_count(); ++v) {
        touched += r.map.points.row(v) != folded.points.row(v);
      }
      CHECK(r.report.touched == touched);
    }
  }
}

TEST_CASE("untangle: vertices more than the ring number away keep their bits") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const SphereMap folded = with_swaps(topology, {mesh.positions}, 1, 3);
  const Untangled r = untangle(topology, measure_source(mesh), folded, {.rings = 3});
  REQUIRE(r.report.rounds == 1);
  std::vector<int> ring(static_cast<size_t>(topology.vertex_count()), 99);
  for (const Face f : folded_faces(topology, folded)) {
    for (int k = 0; k < 3; ++k) ring[static_cast<size_t>(topology.vertex(f, k))] = 0;
  }
  for (int number = 1; number <= 3; ++number) {
    for (Vertex v = 0; v < topology.vertex_count(); ++v) {
      if (ring[static_cast<size_t>(v)] != number - 1) continue;
      topology.for_each_outgoing(v, [&](Halfedge h) {
        int& other = ring[static_cast<size_t>(topology.target(h))];
        other = std::min(other, number);
      });
    }
  }
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    CHECK((r.map.points.row(v) != folded.points.row(v)) == (ring[static_cast<size_t>(v)] <= 3));
  }
}

TEST_CASE("untangle: repairs noise that folds a good part of the sphere") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  for (unsigned seed = 0; seed < 5; ++seed) {
    const SphereMap folded = with_noise({mesh.positions}, 0.15, seed);
    REQUIRE(folded_faces(topology, folded).size() > 50);
    const Untangled r = untangle(topology, source, folded);
    CHECK(r.report.folds_after == 0);
    CHECK(certify(topology, r.map).bijective());
  }
}

TEST_CASE("untangle: a triangle without area is a fold") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  SphereMap flat{mesh.positions};
  flat.points.row(7) = flat.points.row(topology.target(topology.outgoing(7)));
  const Untangled r = untangle(topology, measure_source(mesh), flat);
  CHECK(r.report.folds_before >= 2);
  CHECK(r.report.folds_after == 0);
}

TEST_CASE("untangle: folds far apart are patches of their own") {
  const TriangleMesh mesh = icosphere(5);
  const Topology topology(mesh);
  SphereMap folded{mesh.positions};
  // The twelve corners of the icosahedron: each exchanged with a neighbour.
  for (Vertex v = 0; v < 12; ++v) {
    folded.points.row(v).swap(folded.points.row(topology.target(topology.outgoing(v))));
  }
  const Untangled r = untangle(topology, measure_source(mesh), folded);
  CHECK(r.report.folds_after == 0);
  CHECK(r.report.rounds == 1);
  CHECK(r.report.patches == 12);
  CHECK(r.report.largest_patch < 80);
}

TEST_CASE("untangle: never more folds than before, however little it may do") {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const TriangleMesh mesh = random_sphere_mesh(300, seed);
    const Topology topology(mesh);
    const RestTriangles source = measure_source(mesh);
    const SphereMap folded = radial_map(mesh);
    for (const UntangleOptions& options :
         {UntangleOptions{.rings = 0, .max_rounds = 1}, UntangleOptions{.max_rounds = 2},
          UntangleOptions{.max_patch = 40}, UntangleOptions{.max_patch = 0},
          UntangleOptions{.max_steps = 1}, UntangleOptions{.max_rounds = 0},
          UntangleOptions{.max_work = 1}}) {
      const Untangled r = untangle(topology, source, folded, options);
      CHECK(r.report.folds_after <= r.report.folds_before);
      CHECK(r.report.folds_after == static_cast<long>(folded_faces(topology, r.map).size()));
      CHECK(r.report.largest_patch <= options.max_patch);
      CHECK(r.report.rounds <= options.max_rounds);
      CHECK(r.map.points.allFinite());
    }
  }
}

TEST_CASE("untangle: pinned vertices stay, a sound map comes back as it was") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap sound{mesh.positions};
  CHECK(untangle(topology, source, sound).map.points == sound.points);
  SphereMap folded = sound;
  const Vertex moved = 100, pole = topology.target(topology.outgoing(moved));
  folded.points.row(moved) = -folded.points.row(moved);
  const Untangled r = untangle(topology, source, folded, {.pinned = {pole}});
  CHECK(r.report.folds_after == 0);
  CHECK(r.map.points.row(pole) == sound.points.row(pole));
}

TEST_CASE("untangle: the same bytes for 1, 2 and 4 threads") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap folded = with_swaps(topology, {mesh.positions}, 30, 9);
  const Untangled one = untangle(topology, source, folded, {.threads = 1});
  for (const int threads : {2, 4}) {
    const Untangled many = untangle(topology, source, folded, {.threads = threads});
    CHECK(many.map.points == one.map.points);
    CHECK(many.report.steps == one.report.steps);
  }
}
