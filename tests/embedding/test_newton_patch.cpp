#include <catch2/catch.hpp>

#include "embedding/sweeps/relaxation.h"
#include "folded_maps.h"
#include "sphparam/sphere/certificate.h"
#include "support/reference_newton.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

TriangleMesh stretched_sphere() {
  TriangleMesh mesh = icosphere(3);
  mesh.positions.col(0) *= 3;
  return mesh;
}

}  // namespace

TEST_CASE("newton: reaches a minimum that relaxation cannot lower, in a few steps") {
  const TriangleMesh mesh = stretched_sphere();
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap start{icosphere(3).positions};
  for (const auto kind : {EnergyKind::AngleAndArea, EnergyKind::SymmetricDirichlet}) {
    const DistortionEnergy energy{.kind = kind};
    const NewtonResult r =
        minimise_by_newton(topology, source, start, {.energy = energy, .least_gain = 1e-10});
    CHECK(r.report.converged);
    CHECK(r.report.steps < 25);
    CHECK(certify(topology, r.map).bijective());
    CHECK(r.report.energy_after ==
          Approx(distortion_energy(topology, source, r.map, energy)).epsilon(1e-12));
    const Relaxation swept = relax(topology, source, r.map, {.energy = energy, .sweeps = 20});
    CHECK(swept.report.energy_after > (1 - 1e-6) * r.report.energy_after);
    const Relaxation alone = relax(topology, source, start, {.energy = energy, .sweeps = 20});
    CHECK(r.report.energy_after < alone.report.energy_after);
  }
}

TEST_CASE("newton: moves nothing but the vertices that may move") {
  const TriangleMesh mesh = stretched_sphere();
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap start{icosphere(3).positions};
  std::vector<Vertex> patch;
  for (Vertex v = 100; v < 200; ++v) patch.push_back(v);
  const NewtonResult r =
      minimise_by_newton(topology, source, start, {.vertices = patch, .pinned = {150}});
  CHECK(r.report.energy_after < r.report.energy_before);
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    const bool may_move = v >= 100 && v < 200 && v != 150;
    if (!may_move) CHECK(r.map.points.row(v) == start.points.row(v));
  }
  CHECK(r.map.points.row(120) != start.points.row(120));
}

TEST_CASE("newton: gives a folded map back as it was, and unfolds it when regularised") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const SphereMap folded = with_swaps(topology, {mesh.positions}, 3, 1);
  const size_t folds = folded_faces(topology, folded).size();
  REQUIRE(folds > 0);
  CHECK(minimise_by_newton(topology, source, folded).map.points == folded.points);
  const NewtonResult r =
      minimise_by_newton(topology, source, folded, {.energy = {.epsilon = 0.1}, .max_steps = 60});
  CHECK(r.report.energy_after < r.report.energy_before);
  CHECK(folded_faces(topology, r.map).empty());
}

TEST_CASE("newton: no free vertex, nothing to do") {
  const TriangleMesh mesh = icosphere(1);
  const Topology topology(mesh);
  const NewtonResult r = minimise_by_newton(topology, measure_source(mesh), {mesh.positions},
                                            {.vertices = std::vector<Vertex>{}});
  CHECK(r.map.points == mesh.positions);
  CHECK(r.report.steps == 0);
}
