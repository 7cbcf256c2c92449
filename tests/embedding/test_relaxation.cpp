#include <catch2/catch.hpp>
#include <set>

#include "embedding/sweeps/relaxation.h"
#include "folded_maps.h"
#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// No triangle with a positive determinant may lose it.
bool keeps_what_is_positive(const Topology& topology, const SphereMap& before,
                            const SphereMap& after) {
  for (Face f = 0; f < topology.face_count(); ++f) {
    if (!is_folded(topology, before, f) && is_folded(topology, after, f)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("relax: lowers E sweep by sweep and keeps the map one-to-one") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  SphereMap map = with_noise({mesh.positions}, 0.02, 1);
  REQUIRE(certify(topology, map).bijective());
  for (const auto kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    SphereMap current = map;
    for (int i = 0; i < 5; ++i) {
      const Relaxation r =
          relax(topology, source, current, {.energy = {.kind = kind}, .sweeps = 1});
      CHECK(r.report.energy_after < r.report.energy_before);
      CHECK(r.report.steps > 0);
      CHECK(r.report.skipped == 0);
      current = r.map;
    }
    CHECK(certify(topology, current).bijective());
  }
}

TEST_CASE("relax: finds its way back to the isometry") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const double isometry = distortion_energy(topology, source, {mesh.positions}, {});
  const Relaxation r =
      relax(topology, source, with_noise({mesh.positions}, 0.03, 2), {.sweeps = 60});
  CHECK(r.report.energy_after < 1.0005 * isometry);
}

TEST_CASE("relax: folds stay where they are, nothing else folds, whatever the map") {
  struct Case {
    TriangleMesh mesh;
    SphereMap map;
  };
  std::vector<Case> cases;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const TriangleMesh sphere = icosphere(2);
    const Topology topology(sphere);
    cases.push_back({sphere, with_noise({sphere.positions}, 0.2 * seed, seed)});
    cases.push_back({sphere, with_swaps(topology, {sphere.positions}, 5, seed)});
    // Coincident images, and images that differ by one rounding.
    SphereMap coincident{sphere.positions};
    for (Vertex v = 0; v < 40; v += 4) {
      const Vertex w = topology.target(topology.outgoing(v));
      coincident.points.row(v) = coincident.points.row(w);
      if (v % 8 == 0) coincident.points(v, 0) = std::nextafter(coincident.points(v, 0), 2.0);
    }
    cases.push_back({sphere, coincident});
    // Needles: a sphere squeezed to a thin disk, in the source and in the image.
    TriangleMesh needles = sphere;
    needles.positions.col(0) *= 1e-9;
    cases.push_back({needles, {sphere.positions}});
    Points squeezed = sphere.positions;
    squeezed.col(2) *= 1e-12;
    squeezed.col(1) *= std::pow(10.0, -3.0 * seed);
    cases.push_back({sphere, normalised(squeezed)});
    const TriangleMesh crumpled = random_sphere_mesh(200, seed);
    cases.push_back({crumpled, radial_map(crumpled)});
  }
  const TriangleMesh fan = uv_sphere(5000, 1);
  cases.push_back({fan, {fan.positions}});
  cases.push_back({fan, with_noise({fan.positions}, 1e-4, 1)});
  for (const Case& c : cases) {
    const Topology topology(c.mesh);
    const RestTriangles source = measure_source(c.mesh);
    const Relaxation r = relax(topology, source, c.map, {.sweeps = 5});
    CHECK(keeps_what_is_positive(topology, c.map, r.map));
    const bool folded = !folded_faces(topology, c.map).empty();
    if (folded) CHECK(r.report.skipped > 0);
    CHECK(r.report.energy_after <= r.report.energy_before);
  }
}

TEST_CASE("relax: only the vertices that may move do") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap map = with_noise({mesh.positions}, 0.02, 4);
  const std::vector<Vertex> vertices{5, 17, 80, 81, 82, 17, 83};
  const Relaxation r = relax(topology, source, map, {.vertices = vertices, .pinned = {81, 3}});
  const std::set<Vertex> expected{5, 17, 80, 82, 83};
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    CHECK((r.map.points.row(v) != map.points.row(v)) == (expected.count(v) > 0));
  }
  const Relaxation none = relax(topology, source, map, {.vertices = std::vector<Vertex>{}});
  CHECK(none.map.points == map.points);
  const Relaxation poles = relax(topology, source, map, {.pinned = {3}});
  CHECK(poles.map.points.row(3) == map.points.row(3));
  CHECK(poles.map.points.row(4) != map.points.row(4));
}

TEST_CASE("relax: more weight on area gives truer areas, more on angles truer angles") {
  TriangleMesh mesh = icosphere(3);
  mesh.positions.col(0) *= 3;
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap map = radial_map(icosphere(3));
  const auto angle_part = [&](double lambda) {
    const Relaxation r = relax(topology, source, map, {.energy = {.lambda = lambda}, .sweeps = 40});
    return distortion_energy(topology, source, r.map, {.lambda = 0});
  };
  CHECK(angle_part(1e-3) < angle_part(1));
  CHECK(angle_part(1) < angle_part(100));
}

TEST_CASE("relax: the same bytes for 1, 2 and 4 threads") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap map = with_noise({mesh.positions}, 0.01, 6);
  const Relaxation one = relax(topology, source, map, {.threads = 1});
  for (const int threads : {2, 4}) {
    const Relaxation many = relax(topology, source, map, {.threads = threads});
    CHECK(many.map.points == one.map.points);
    CHECK(many.report.steps == one.report.steps);
    CHECK(many.report.energy_after == one.report.energy_after);
  }
}

TEST_CASE("relax: tells how far it is and can be stopped") {
  const TriangleMesh mesh = icosphere(1);
  const Topology topology(mesh);
  std::vector<double> told;
  const Progress twice = [&](std::string_view, double fraction) {
    told.push_back(fraction);
    return told.size() < 2;
  };
  CHECK_THROWS_AS(
      relax(topology, measure_source(mesh), {mesh.positions}, {.sweeps = 4, .progress = twice}),
      Cancelled);
  CHECK(told == std::vector<double>{0.25, 0.5});
}
