#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "sphparam/baselines/brechbuehler.h"
#include "sphparam/baselines/conformal.h"
#include "sphparam/baselines/curvature_flow.h"
#include "sphparam/baselines/hemispheres.h"
#include "sphparam/baselines/stereographic.h"
#include "sphparam/baselines/tangential.h"
#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

// What all methods of the room promise.

using namespace sphparam;
using namespace sphparam::tests;

namespace {

struct Baseline {
  std::string name;
  std::function<BaselineResult(const TriangleMesh&, const Topology&, int threads, const Progress&)>
      map;
};

std::vector<Baseline> all_baselines() {
  return {
      {"tangential",
       [](auto& mesh, auto& topology, int threads, auto& progress) {
         return map_tangential(mesh, topology, {.max_sweeps = 1000, .threads = threads}, progress);
       }},
      {"uniform",
       [](auto& mesh, auto& topology, int threads, auto& progress) {
         return map_tangential(mesh, topology,
                               {.laplacian = TangentialOptions::Operator::Uniform,
                                .max_sweeps = 1000,
                                .threads = threads},
                               progress);
       }},
      {"hemispheres",
       [](auto& mesh, auto& topology, int threads, auto& progress) {
         return map_hemispheres(mesh, topology, {.threads = threads}, progress);
       }},
      {"brechbuehler",
       [](auto& mesh, auto& topology, int threads, auto& progress) {
         return map_brechbuehler(mesh, topology, {.max_steps = 20, .threads = threads}, progress);
       }},
      {"stereographic",
       [](auto& mesh, auto& topology, int threads, auto& progress) {
         return map_stereographic(mesh, topology, {.threads = threads}, progress);
       }},
      {"conformal",
       [](auto& mesh, auto& topology, int threads, auto& progress) {
         return map_conformal(mesh, topology, {.max_iterations = 300, .threads = threads},
                              progress);
       }},
      {"flow", [](auto& mesh, auto& topology, int threads, auto& progress) {
         return map_flow(mesh, topology, {.max_steps = 30, .threads = threads}, progress);
       }}};
}

/// All vertices in one place: no area, no angles, no weights.
TriangleMesh collapsed(TriangleMesh mesh) {
  mesh.positions.setOnes();
  return mesh;
}

}  // namespace

TEST_CASE("baselines: every method ends in a finite map of unit rays or says why there is none") {
  TriangleMesh flat = icosphere(2);
  flat.positions.col(2).setZero();
  for (const TriangleMesh& mesh :
       {tetrahedron(), octahedron(), icosphere(2), uv_sphere(12, 1), tube(60, 5),
        random_sphere_mesh(300, 7), flat, collapsed(icosphere(1))}) {
    const Topology topology(mesh);
    for (const Baseline& baseline : all_baselines()) {
      INFO(baseline.name << " of " << mesh.vertex_count() << " vertices");
      const BaselineResult result = baseline.map(mesh, topology, 1, {});
      CHECK_FALSE(result.statement.empty());
      REQUIRE(result.map.has_value() == (result.end != BaselineEnd::NoResult));
      if (!result.map) continue;
      REQUIRE(result.map->points.rows() == mesh.vertex_count());
      CHECK(result.map->points.allFinite());
      CHECK((result.map->points.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-12);
      const Certificate certificate = certify(topology, *result.map);
      CHECK(certificate.unusable_points.empty());
      int iterations = 0;
      for (const BaselineStage& stage : result.stages) iterations += stage.iterations;
      CHECK(iterations == result.iterations);
    }
  }
}

TEST_CASE("baselines: every method maps a sphere one-to-one") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  for (const Baseline& baseline : all_baselines()) {
    INFO(baseline.name);
    const BaselineResult result = baseline.map(mesh, topology, 1, {});
    REQUIRE(result.map);
    CHECK(certify(topology, *result.map).bijective());
  }
}

TEST_CASE("baselines: the number of threads changes no bit") {
  const TriangleMesh mesh = tube(60, 100);  // more vertices than a chunk
  const Topology topology(mesh);
  for (const Baseline& baseline : all_baselines()) {
    INFO(baseline.name);
    const BaselineResult one = baseline.map(mesh, topology, 1, {});
    const BaselineResult three = baseline.map(mesh, topology, 3, {});
    REQUIRE(one.map);
    REQUIRE(three.map);
    CHECK(one.map->points == three.map->points);
    CHECK(one.statement == three.statement);
  }
}

TEST_CASE("baselines: maps do not depend on size, where squares overflow or vanish either") {
  TriangleMesh mesh = tube(12, 12);
  mesh.positions /= mesh.positions.cwiseAbs().maxCoeff();
  const Topology topology(mesh);
  const Bisection bisection = bisect(mesh, topology, 1);
  const SphereMap placed = place_hemispheres(mesh, topology, bisection, 1);
  for (const int exponent : {-1000, -350, 350, 1000}) {
    TriangleMesh other = mesh;
    other.positions *= std::ldexp(1.0, exponent);
    CHECK(bisect(other, topology, 1).seam == bisection.seam);
    CHECK(place_hemispheres(other, topology, bisection, 1).points == placed.points);
    for (const Baseline& baseline : all_baselines()) {
      INFO(baseline.name << ", times 2^" << exponent);
      const BaselineResult result = baseline.map(mesh, topology, 1, {});
      const BaselineResult scaled = baseline.map(other, topology, 1, {});
      REQUIRE(result.map);
      REQUIRE(scaled.map);
      CHECK(scaled.map->points == result.map->points);
      CHECK(scaled.statement == result.statement);
    }
  }
}

TEST_CASE("baselines: every method can be cancelled") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const Progress never = [](std::string_view, double) { return false; };
  for (const Baseline& baseline : all_baselines()) {
    INFO(baseline.name);
    CHECK_THROWS_AS(baseline.map(mesh, topology, 1, never), Cancelled);
  }
}
