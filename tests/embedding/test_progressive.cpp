#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "embedding/constructions/progressive.h"
#include "embedding/sweeps/kernel_placement.h"
#include "embedding/sweeps/relaxation.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/orientation.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("progressive: protrusions, hubs and random connectivity are embedded without a fold") {
  const int which = GENERATE(0, 1, 2, 3, 4);
  const TriangleMesh mesh = which == 0   ? tetrahedron()
                            : which == 1 ? icosphere(4)
                            : which == 2 ? tube(1000, 6)
                            : which == 3 ? uv_sphere(5000, 1)
                                         : random_sphere_mesh(4000, 9);
  const Topology topology(mesh);
  const ProgressiveEmbedding embedding = embed_progressively(mesh, topology);
  REQUIRE(embedding.map);
  CHECK(certify(topology, *embedding.map).bijective());
}

TEST_CASE("progressive: protrusions thousands of times longer than wide find room in the end") {
  // At λ = 1 some of these run out of doubles; more weight on areas keeps the tips apart.
  for (const auto& [rings, around] : {std::pair{1000, 7}, {4000, 6}}) {
    const TriangleMesh mesh = tube(rings, around);
    const Topology topology(mesh);
    const ProgressiveEmbedding embedding = embed_progressively(mesh, topology);
    REQUIRE(embedding.map);
    CHECK(certify(topology, *embedding.map).bijective());
  }
}

TEST_CASE("progressive: the same bits for 1, 2 and 4 threads, for both energies") {
  const TriangleMesh mesh = tube(120, 8);
  const Topology topology(mesh);
  for (const EnergyKind kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    const auto points = [&](int threads) {
      return embed_progressively(mesh, topology, {.energy = {.kind = kind}, .threads = threads})
          .map->points;
    };
    const Points one = points(1);
    CHECK(points(2) == one);
    CHECK(points(4) == one);
  }
}

TEST_CASE("progressive: a sphere comes out nearly isometric") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const DistortionEnergy energy;
  const ProgressiveEmbedding embedding = embed_progressively(mesh, topology, {.energy = energy});
  const double ideal = distortion_energy(topology, source, {mesh.positions}, energy);
  CHECK(distortion_energy(topology, source, *embedding.map, energy) < 1.001 * ideal);
}

TEST_CASE("progressive: vector steps and scalar relaxation lower the same energy") {
  // Where the sweeps have ended, scalar Newton steps find next to nothing to gain.
  const TriangleMesh mesh = uv_sphere(40, 20);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  for (const EnergyKind kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    const DistortionEnergy energy{.kind = kind};
    const SphereMap map =
        *embed_progressively(mesh, topology, {.energy = energy, .sweeps = 60}).map;
    const Relaxation relaxed = relax(topology, source, map, {.energy = energy, .sweeps = 20});
    CHECK(relaxed.report.energy_after <= relaxed.report.energy_before);
    CHECK(relaxed.report.energy_after > 0.999 * relaxed.report.energy_before);
  }
}

namespace {

double energy_at(const TriangleMesh& mesh, Quality quality, EnergyKind kind = {}) {
  const Topology topology(mesh);
  const ProgressiveEmbedding embedding =
      embed_progressively(mesh, topology, {.energy = {.kind = kind}, .quality = quality});
  REQUIRE(embedding.map);
  CHECK(certify(topology, *embedding.map).bijective());
  return distortion_energy(topology, measure_source(mesh), *embedding.map, {.kind = kind});
}

}  // namespace

TEST_CASE("progressive: slivers cost nothing: a sphere with them comes out nearly isometric too") {
  for (const double at : {0.01, 0.001}) {
    const TriangleMesh mesh = with_slivers(icosphere(4), 0.2, at, 7);
    Points rays = mesh.positions;
    rays.rowwise().normalize();
    const double ideal = distortion_energy(Topology(mesh), measure_source(mesh), {rays}, {});
    CHECK(energy_at(mesh, Quality::Draft) < 1.01 * ideal);
    CHECK(energy_at(mesh, Quality::Normal) < 1.01 * ideal);
  }
}

TEST_CASE(
    "progressive: bristles and rods end within 2 % of their least energy in any order of "
    "vertices") {
  const std::vector<TriangleMesh> shapes{brush(1, 3, 10, 30), dumbbell(30, 0.02, 12)};
  for (const TriangleMesh& shape : shapes) {
    const double best = energy_at(shape, Quality::Best);
    for (unsigned order = 1; order <= 10; ++order) {
      const double normal = energy_at(relabelled(shape, order), Quality::Normal);
      CHECK(normal < 1.02 * best);
      CHECK(normal > 0.995 * best);
    }
  }
}

TEST_CASE("progressive: no quality is better than the next one") {
  const std::vector<TriangleMesh> shapes{
      icosphere(4),        uv_sphere(40, 20),
      tube(60, 16),        random_sphere_mesh(2000, 4),
      brush(1, 3, 10, 30), with_slivers(tube(30, 12), 0.2, 0.01, 2)};
  for (const TriangleMesh& shape : shapes) {
    const double normal = energy_at(shape, Quality::Normal);
    CHECK(normal <= (1 + 1e-4) * energy_at(shape, Quality::Draft));
    CHECK(energy_at(shape, Quality::Best) <= normal);
  }
}

TEST_CASE("progressive: a draft of a large mesh leaves out steps that gain little, and says so") {
  const TriangleMesh shape = brush(4, 20, 8, 60);
  const Topology topology(shape);
  const ProgressiveEmbedding draft =
      embed_progressively(shape, topology, {.quality = Quality::Draft});
  const double more = distortion_energy(topology, measure_source(shape), draft.map.value(), {}) /
                          energy_at(shape, Quality::Normal) -
                      1;
  CHECK(more > 1e-3);  // with steps on the finest level it is next to nothing
  CHECK(more < 0.05);
  CHECK(draft.report.energy_left > more);
  CHECK(draft.report.energy_left < 0.05);
}

TEST_CASE("progressive: limbs end alike in every order of vertices") {
  for (const TriangleMesh& shape : {brush(1, 3, 20, 30), brush(2, 7, 10, 12)}) {
    double least = 1e300, most = 0;
    for (unsigned order = 1; order <= 4; ++order) {
      const double energy = energy_at(relabelled(shape, order), Quality::Normal);
      least = std::min(least, energy);
      most = std::max(most, energy);
    }
    CHECK(most < 1.003 * least);
  }
}

/// Of the mesh, as that map has them once it is turned.
std::vector<Pin> turned_pins(const SphereMap& map, int count) {
  std::vector<Pin> pins;
  for (int i = 0; i < count; ++i) {
    const Vertex v = static_cast<Vertex>((7919L * i + 13) % map.points.rows());
    const Vector3 point = map.point(v);
    pins.push_back({v, {point.y(), point.z(), point.x()}});
  }
  return pins;
}

TEST_CASE("progressive: pins where the free map has them cost limbs nothing") {
  const TriangleMesh mesh = brush(2, 7, 10, 12);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const ProgressiveEmbedding free = embed_progressively(mesh, topology);
  const double energy = distortion_energy(topology, source, free.map.value(), {});
  const std::vector<Pin> pins = turned_pins(*free.map, 5);

  const ProgressiveEmbedding alone = embed_progressively(mesh, topology, {.pins = pins});
  CHECK(all_exact(pin_residuals(alone.map.value(), pins)));
  CHECK(distortion_energy(topology, source, *alone.map, {}) < 1.05 * energy);

  const ProgressiveEmbedding led =
      embed_progressively(mesh, topology, {.pins = pins, .free_map = &*free.map});
  CHECK(all_exact(pin_residuals(led.map.value(), pins)));
  CHECK(distortion_energy(topology, source, *led.map, {}) < 1.001 * energy);
}

TEST_CASE("progressive: pins off the free map's places are reached all the same") {
  const TriangleMesh mesh = brush(1, 3, 20, 30);
  const Topology topology(mesh);
  const ProgressiveEmbedding free = embed_progressively(mesh, topology);
  std::vector<Pin> pins = turned_pins(free.map.value(), 4);
  for (Pin& pin : pins) pin.point = (pin.point + Vector3(0.1, -0.15, 0.05)).normalized();
  const ProgressiveEmbedding led =
      embed_progressively(mesh, topology, {.pins = pins, .free_map = &*free.map, .threads = 1});
  CHECK(all_exact(pin_residuals(led.map.value(), pins)));
  CHECK(certify(topology, *led.map).bijective());
  const ProgressiveEmbedding again =
      embed_progressively(mesh, topology, {.pins = pins, .free_map = &*free.map, .threads = 3});
  CHECK(again.map->points == led.map->points);
}

TEST_CASE("progressive: where minima are many, what is left says how far two are apart") {
  double least = 1e300, most = 0, left = 1;
  for (unsigned order = 1; order <= 3; ++order) {
    const TriangleMesh mesh = relabelled(dumbbell(100, 0.05, 8), order);
    const Topology topology(mesh);
    const ProgressiveEmbedding embedding = embed_progressively(mesh, topology);
    REQUIRE(embedding.map);
    const double energy = distortion_energy(topology, measure_source(mesh), *embedding.map, {});
    least = std::min(least, energy);
    most = std::max(most, energy);
    left = std::min(left, embedding.report.energy_left.value());
  }
  CHECK(left > 0.005);
  CHECK(most / least - 1 < 2 * left);
}

TEST_CASE("progressive: says how much of the energy is left") {
  for (const TriangleMesh& mesh : {icosphere(4), tube(60, 16), tube(200, 8)}) {
    const Topology topology(mesh);
    const auto left = [&](Quality quality) {
      return embed_progressively(mesh, topology, {.quality = quality}).report.energy_left;
    };
    CHECK(left(Quality::Draft).has_value() == (mesh.face_count() != icosphere(4).face_count()));
    REQUIRE(left(Quality::Normal));
    const double gap = 1 - energy_at(mesh, Quality::Best) / energy_at(mesh, Quality::Normal);
    CHECK(*left(Quality::Normal) > gap / 5);
    // How far two starts end apart counts as left, 1.5 % here, where the lower one is at its least.
    CHECK(*left(Quality::Normal) < 5 * gap + 0.02);
    CHECK(*left(Quality::Best) < 0.01);
  }
}

TEST_CASE("progressive: where steps stopped with much left they go on") {
  // Of sixty steps here and no more 1.9 % is left.
  const TriangleMesh mesh = with_slivers(with_slivers(tube(5, 6), 0.3, 1e-5, 1), 0.3, 1e-5, 2);
  const Topology topology(mesh);
  const auto embedded = [&](Quality quality) {
    return embed_progressively(mesh, topology, {.quality = quality});
  };
  const ProgressiveEmbedding normal = embedded(Quality::Normal), best = embedded(Quality::Best);
  REQUIRE(normal.map);
  REQUIRE(best.map);
  CHECK(certify(topology, *normal.map).bijective());
  REQUIRE(normal.report.energy_left);
  CHECK(*normal.report.energy_left < 5e-3);
  const RestTriangles source = measure_source(mesh);
  CHECK(distortion_energy(topology, source, *normal.map, {}) <
        1.01 * distortion_energy(topology, source, *best.map, {}));
}

TEST_CASE("kernel_placement: the point sees every edge of its ring, however thin the kernel") {
  // A ring that is a star with deep bays: the mean lies outside the kernel.
  std::vector<Vector3> ring;
  for (int i = 0; i < 12; ++i) {
    const double angle = 6.283185307179586 * i / 12, r = i % 2 ? 0.02 : 0.5;
    const double shift = i < 6 ? 0.3 : 0;
    ring.push_back(Vector3(r * std::cos(angle) + shift * r, r * std::sin(angle), 1).normalized());
  }
  const auto point = place_in_kernel(ring);
  REQUIRE(point);
  for (size_t i = 0; i < ring.size(); ++i) {
    CHECK(orientation(*point, ring[i], ring[(i + 1) % ring.size()]) > 0);
  }
}

TEST_CASE("kernel_placement: a ring without a kernel gets no point") {
  // Two triangles that wind opposite ways: no point sees both.
  std::vector<Vector3> ring;
  for (const auto& [x, y] :
       {std::pair{-1.0, -1.0}, {0.0, 0.0}, {1.0, -1.0}, {1.0, 1.0}, {0.0, 0.1}, {-1.0, 1.0}}) {
    ring.push_back(Vector3(x, y, 4).normalized());
  }
  std::swap(ring[1], ring[4]);
  CHECK_FALSE(place_in_kernel(ring));
}

TEST_CASE("progressive: shapes that have collapsed into three places are embedded all the same") {
  for (unsigned seed = 0; seed < 6; ++seed) {
    TriangleMesh mesh = random_sphere_mesh(600, seed);
    const Topology topology(mesh);
    std::mt19937 random(seed);
    const Points places = mesh.positions.topRows(3);
    for (Vertex v = 0; v < topology.vertex_count(); ++v) {
      mesh.positions.row(v) = places.row(static_cast<Eigen::Index>(random() % 3));
    }
    const ProgressiveEmbedding embedding = embed_progressively(mesh, topology);
    REQUIRE(embedding.map);
    CHECK(certify(topology, *embedding.map).bijective());
  }
}

TEST_CASE("progressive: where the shape leaves no room, connectivity alone does") {
  for (const unsigned seed : {2u, 5u}) {  // these have none, whatever the weight of areas
    TriangleMesh mesh = random_sphere_mesh(1500, seed);
    const Topology topology(mesh);
    std::mt19937 random(seed);
    Points places(3, 3);
    for (int i = 0; i < 3; ++i) places.row(i) = mesh.positions.row(random() % 1500);
    for (Vertex v = 0; v < topology.vertex_count(); ++v) {
      mesh.positions.row(v) = places.row(static_cast<Eigen::Index>(random() % 3));
    }
    const ProgressiveEmbedding embedding = embed_progressively(mesh, topology);
    REQUIRE(embedding.map);
    CHECK(certify(topology, *embedding.map).bijective());
  }
}

TEST_CASE("progressive: what was found by another energy is brought near the one asked for") {
  const TriangleMesh mesh = tube(400, 12);  // has no room at λ = 1 until areas weigh more
  const Topology topology(mesh);
  const auto energy_of = [&](Quality quality) {
    const ProgressiveEmbedding embedding =
        embed_progressively(mesh, topology, {.quality = quality});
    REQUIRE(embedding.map);
    CHECK(certify(topology, *embedding.map).bijective());
    return distortion_energy(topology, measure_source(mesh), *embedding.map, {});
  };
  // The least of a round tube of this length whose rings lie on circles of latitude, by a search
  // over their latitudes: no map that is twisted comes near.
  const double round = 30.729 * 4 * std::numbers::pi;
  const double normal = energy_of(Quality::Normal);
  CHECK(normal < 1.05 * round);
  CHECK(energy_of(Quality::Draft) < 1.05 * normal);
}
