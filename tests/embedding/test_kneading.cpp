#include <catch2/catch.hpp>

#include "embedding/constructions/kneading.h"
#include "embedding/constructions/level_embedding.h"
#include "embedding/constructions/progressive.h"
#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

TriangleMesh long_tube(int rings, int around, double aspect) {
  TriangleMesh mesh = tube(rings, around);
  mesh.positions.col(2) *= 2 * aspect / rings;
  return mesh;
}

/// Over an isometry's of the sphere.
double energy_of(const TriangleMesh& mesh, const SphereMap& map) {
  return distortion_energy(Topology(mesh), measure_source(mesh), map, {}) / (8 * M_PI);
}

}  // namespace

TEST_CASE("kneading: a map comes back in one piece, pins where they were, by any threads") {
  const TriangleMesh mesh = long_tube(60, 6, 30);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap map = *embed_progressively(mesh, topology, {.quality = Quality::Draft}).map;
  const std::vector<Vertex> pinned = {3, 100};
  for (const Kneading way : {Kneading::ByAreas, Kneading::ByAngles}) {
    const auto kneaded_by = [&](int threads) {
      return knead(topology, source, map, way, {.pinned = pinned, .threads = threads});
    };
    const SphereMap kneaded = kneaded_by(1);
    CHECK(certify(topology, kneaded).bijective());
    for (const Vertex v : pinned) CHECK(kneaded.point(v) == map.point(v));
    CHECK(kneaded.point(50) != map.point(50));
    CHECK(kneaded.points == kneaded_by(3).points);
    CHECK(energy_of(mesh, kneaded) < 2 * energy_of(mesh, map));
  }
}

TEST_CASE("kneading: again and again, it leads a long tube to a much lower minimum") {
  const TriangleMesh mesh = long_tube(100, 5, 200);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const auto settled = [&](const SphereMap& map) {
    return optimise(topology, source, map, {.least_gain = 1e-5}).map;
  };
  const SphereMap first = settled(*embed_by_levels(mesh, topology, {}, {}, {}).map);
  SphereMap last = first;
  for (int round = 0; round < 4; ++round)
    last = settled(knead(topology, source, last, Kneading::ByAngles, {}));
  CHECK(energy_of(mesh, last) < 0.85 * energy_of(mesh, first));
  const SphereMap embedded = *embed_progressively(mesh, topology).map;
  CHECK(energy_of(mesh, embedded) < 1.01 * energy_of(mesh, last));
}
