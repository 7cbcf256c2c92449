#include <catch2/catch.hpp>
#include <cmath>

#include "embedding/constructions/progressive.h"
#include "embedding/newton/pressed_fillers.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/sphere_share.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A ball of which all that is higher than this is filler.
struct Bowl {
  TriangleMesh mesh;
  Topology topology;
  SphereMap map;
  FillerMarks fillers;

  explicit Bowl(double height, int level = 4)
      : mesh(icosphere(level)), topology(mesh), map{mesh.positions} {
    for (Face f = 0; f < mesh.face_count(); ++f) {
      const double z =
          (mesh.positions(mesh.triangles(f, 0), 2) + mesh.positions(mesh.triangles(f, 1), 2) +
           mesh.positions(mesh.triangles(f, 2), 2)) /
          3;
      fillers.push_back(z > height ? 1 : 0);
    }
  }

  double share(const SphereMap& of) const { return sphere_share(mesh.triangles, of, fillers); }
  PressedMap pressed(double most, int threads = 1) const {
    return press_fillers(topology, measure_source(mesh), map, most,
                         {.least_gain = 1e-3, .pressed = fillers, .threads = threads});
  }
};

}  // namespace

TEST_CASE("pressed fillers: the share of a cap is its share of the sphere") {
  const Bowl bowl(0.5, 6);
  CHECK(bowl.share(bowl.map) == Approx(0.25).epsilon(0.02));
  CHECK(sphere_share(bowl.mesh.triangles, bowl.map, {}) == 0);
  CHECK(sphere_share(bowl.mesh.triangles, bowl.map,
                     FillerMarks(static_cast<size_t>(bowl.mesh.face_count()), 1)) == Approx(1));
}

TEST_CASE("pressed fillers: they end at their share or below, and the map stays one-to-one") {
  for (const double height : {0.8, 0.3, 0.0, -0.4}) {
    const Bowl bowl(height);
    for (const double most : {0.02, 0.1}) {
      INFO("above " << height << ", at most " << most);
      const PressedMap result = bowl.pressed(most);
      CHECK(result.share <= most);
      CHECK(result.share == bowl.share(result.map));
      CHECK(result.share > 0.3 * std::min(most, bowl.share(bowl.map)));  // no more than asked for
      CHECK(certify(bowl.topology, result.map).bijective());
    }
  }
}

TEST_CASE("pressed fillers: what is small enough is left as it is") {
  const Bowl bowl(0.97);
  const PressedMap result = bowl.pressed(0.1);
  CHECK(result.map.points == bowl.map.points);
  CHECK(result.pressure == 0);
}

TEST_CASE("pressed fillers: the same bits for any number of threads") {
  const Bowl bowl(0.2, 5);
  CHECK(bowl.pressed(0.02, 1).map.points == bowl.pressed(0.02, 3).map.points);
}

TEST_CASE("pressed fillers: pressure adds its multiple of the area, and no more") {
  const Bowl bowl(0.4, 3);
  const RestTriangles source = measure_source(bowl.mesh);
  const auto energy = [&](double pressure) {
    return optimise(bowl.topology, source, bowl.map,
                    {.energy = {.pressure = pressure}, .max_steps = 0, .pressed = bowl.fillers})
        .report.energy_before;
  };
  double half_determinants = 0;
  for (Face f = 0; f < bowl.mesh.face_count(); ++f) {
    if (!bowl.fillers[static_cast<size_t>(f)]) continue;
    const auto ray = [&](int k) { return bowl.map.point(bowl.mesh.triangles(f, k)); };
    half_determinants += ray(0).dot(ray(1).cross(ray(2))) / 2;
  }
  CHECK(energy(3) - energy(0) == Approx(3 * half_determinants).epsilon(1e-6));
}

TEST_CASE("pressed fillers: marks without a pressure change no bit") {
  const Bowl bowl(0.4);
  const RestTriangles source = measure_source(bowl.mesh);
  for (const auto kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    const auto optimised = [&](double pressure, const FillerMarks& pressed) {
      return optimise(bowl.topology, source,
                      normalised(bowl.map.points * Vector3(1, 2, 3).asDiagonal()),
                      {.energy = {.kind = kind, .pressure = pressure}, .pressed = pressed});
    };
    const Optimisation plain = optimised(0, {});
    CHECK(plain.report.energy_after < plain.report.energy_before);
    for (const double nothing : {0.0, -0.0}) {
      const Optimisation marked = optimised(nothing, bowl.fillers);
      CHECK(marked.map.points == plain.map.points);
      CHECK(marked.report.energy_after == plain.report.energy_after);
    }
  }
}

TEST_CASE(
    "pressed fillers: where their areas alone are enough, the map is the best one for these") {
  const Bowl bowl(0.74);
  const PressedMap result = bowl.pressed(0.1);
  REQUIRE(bowl.share(bowl.map) > 0.1);
  REQUIRE(result.pressure == 0);
  CHECK(result.share <= 0.1);
  RestTriangles source = measure_source(bowl.mesh);
  double of_fillers = 0, of_all = 0;
  for (size_t f = 0; f < source.size(); ++f) {
    of_all += source[f].area;
    of_fillers += bowl.fillers[f] ? source[f].area : 0;
  }
  const auto [filler, surface] = pressed_areas(of_fillers, of_all - of_fillers, 0.1);
  for (size_t f = 0; f < source.size(); ++f) {
    source[f] = scaled(source[f], bowl.fillers[f] ? filler : surface);
  }
  const Optimisation best = optimise(bowl.topology, source, bowl.map, {.least_gain = 1e-6});
  CHECK(*result.energy < 1.001 * best.report.energy_after);
}

TEST_CASE("pressed fillers: steps, with sweeps and without, draw out what is rewarded") {
  const Bowl bowl(0.2, 4);
  const RestTriangles source = measure_source(bowl.mesh);
  FillerMarks surface;
  for (const unsigned char mark : bowl.fillers) surface.push_back(mark ? 0 : 1);
  for (const int sweeps : {0, 4}) {
    const Optimisation result = optimise(
        bowl.topology, source, bowl.map,
        {.energy = {.pressure = -20}, .least_gain = 1e-4, .sweeps = sweeps, .pressed = surface});
    INFO(sweeps << " sweeps");
    CHECK(result.report.energy_after < result.report.energy_before);
    CHECK(bowl.share(result.map) < 0.5 * bowl.share(bowl.map));
    CHECK(certify(bowl.topology, result.map).bijective());
  }
}

TEST_CASE(
    "pressed fillers: the embedding presses them on its coarse levels, the same bits always") {
  const Bowl bowl(0.2, 5);
  const auto embedded = [&](int threads) {
    return embed_progressively(bowl.mesh, bowl.topology,
                               {.fillers = bowl.fillers, .filler_share = 0.02, .threads = threads});
  };
  const ProgressiveEmbedding embedding = embedded(1);
  REQUIRE(embedding.map);
  CHECK(embedding.report.pressure > 0);
  CHECK(certify(bowl.topology, *embedding.map).bijective());
  CHECK(bowl.share(*embedding.map) < 0.04);  // sweeps alone on the finest level
  CHECK(embedded(3).map->points == embedding.map->points);
  const PressedMap settled = press_fillers(
      bowl.topology, measure_source(bowl.mesh), *embedding.map, 0.02,
      {.least_gain = 1e-2, .pressed = bowl.fillers, .threads = 1}, embedding.report.pressure);
  CHECK(settled.share <= 0.02);
  CHECK(settled.share > 0.01);
}

TEST_CASE("pressed fillers: small enough on meshes of a few triangles too, and with their poles") {
  for (const TriangleMesh& closed : {octahedron(), icosahedron(), icosphere(1)}) {
    TriangleMesh open = closed;
    open.triangles = closed.triangles.bottomRows(closed.face_count() - 2);
    RepairOptions options;
    options.keep_holes = true;
    const RepairedMesh mended = repair_mesh(open, options);
    const Parameterization map =
        parameterize(mended.mesh, {.fillers = mended.fillers, .filler_share = 0.02});
    INFO(closed.face_count() << " triangles");
    CHECK(map.certificate.bijective());
    REQUIRE(map.filler_share);
    CHECK(*map.filler_share <= 0.02);
    if (map.poles) CHECK(map.map.point(map.poles->south) == -Vector3::UnitZ());
  }
}

TEST_CASE("pressed fillers: limbs fold as well around them as without, by all qualities") {
  const TriangleMesh mesh = brush(3, 12, 20, 60);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  FillerMarks fillers;  // the lower half of the ball, between bristles
  for (Face f = 0; f < mesh.face_count(); ++f) {
    double height = 0, farthest = 0;
    for (int k = 0; k < 3; ++k) {
      height += mesh.positions(mesh.triangles(f, k), 2) / 3;
      farthest = std::max(farthest, mesh.positions.row(mesh.triangles(f, k)).norm());
    }
    fillers.push_back(height < 0 && farthest < 1.001 ? 1 : 0);
  }
  const auto energy = [&](Quality quality) {
    const SphereMap map = parameterize(mesh, {.fillers = fillers, .quality = quality}).map;
    CHECK(sphere_share(mesh.triangles, map, fillers) <= 0.02);
    // As they count, once they are pressed.
    return press_fillers(topology, source, map, 0.02, {.max_steps = 0, .pressed = fillers}, 1)
        .energy.value();
  };
  const double best = energy(Quality::Best);
  CHECK(energy(Quality::Normal) < 1.01 * best);
  CHECK(energy(Quality::Draft) < 1.03 * best);
}
