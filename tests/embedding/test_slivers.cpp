#include <catch2/catch.hpp>

#include "embedding/constructions/level_embedding.h"
#include "embedding/constructions/progressive.h"
#include "embedding/constructions/slivers.h"
#include "sphparam/sphere/certificate.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

TriangleMesh long_ball() {
  TriangleMesh mesh = icosphere(2);
  mesh.positions.col(0) *= 4;
  return mesh;
}

/// The same with slivers of slivers of slivers, a millionth as wide as long, and thinner.
TriangleMesh splintered() {
  TriangleMesh mesh = icosphere(2);
  for (const unsigned seed : {5U, 6U, 7U}) mesh = with_slivers(mesh, 0.33, 1e-6, seed);
  mesh.positions.col(0) *= 4;
  return mesh;
}

double energy_of(const TriangleMesh& mesh, const SphereMap& map) {
  return distortion_energy(Topology(mesh), measure_source(mesh), map, {});
}

}  // namespace

TEST_CASE("slivers: they are seen where there are many, thin ones and tiny ones") {
  const auto seen = [](const TriangleMesh& mesh) { return has_slivers(measure_source(mesh)); };
  CHECK_FALSE(seen(icosphere(3)));
  CHECK_FALSE(seen(with_slivers(icosphere(3), 0.01, 1e-3, 1)));
  CHECK(seen(with_slivers(icosphere(3), 0.2, 1e-3, 1)));
  TriangleMesh crowded = icosphere(3);  // a tenth of its vertices within a ten-thousandth
  for (Vertex v = 0; v < crowded.vertex_count(); ++v) {
    if (crowded.positions(v, 2) < 0.8) continue;
    const Vector3 top(0, 0, 1);
    crowded.positions.row(v) = top + 1e-4 * (crowded.position(v) - top);
  }
  CHECK(seen(crowded));
}

TEST_CASE("slivers: slimmed from step to step a map comes lower than by steps among slim ones") {
  const TriangleMesh mesh = splintered();
  const Topology topology(mesh);
  const auto embedded = [&](double fatness) {
    return *embed_by_levels(mesh, topology, {}, {}, {.fatness = fatness}).map;
  };
  const SphereMap fat = embedded(fattening);
  const SphereMap slim =
      slim_down(topology, measure_source(mesh), fat, {.least_gain = 1e-3, .max_steps = 80});
  CHECK(certify(topology, slim).bijective());
  CHECK(energy_of(mesh, slim) < 0.9 * energy_of(mesh, fat));
  CHECK(energy_of(mesh, slim) < 0.98 * energy_of(mesh, embedded(0)));
}

TEST_CASE("slivers: where no triangle is thin nothing is slimmed away but what was fattened") {
  const TriangleMesh mesh = icosphere(3);
  const SphereMap map{mesh.positions};
  const SphereMap same = slim_down(Topology(mesh), measure_source(mesh), map, {.max_steps = 0});
  CHECK(same.points == map.points);
}

TEST_CASE("slivers: what is splintered is mapped about as well as it would be whole") {
  const TriangleMesh mesh = splintered(), whole = long_ball();
  const Topology topology(mesh);
  const double ideal = energy_of(
      whole, *embed_progressively(whole, Topology(whole), {.quality = Quality::Best}).map);
  for (const Quality quality : {Quality::Draft, Quality::Normal}) {
    const auto embedded = [&](int threads) {
      return embed_progressively(mesh, topology, {.quality = quality, .threads = threads});
    };
    const ProgressiveEmbedding one = embedded(1), three = embedded(3);
    CHECK(certify(topology, *one.map).bijective());
    CHECK(one.map->points == three.map->points);
    CHECK(energy_of(mesh, *one.map) < 1.1 * ideal);
    CHECK(one.report.energy_left < 0.02);
  }
}
