#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "baselines/mobius_centring.h"
#include "sphparam/baselines/conformal.h"
#include "sphparam/baselines/curvature_flow.h"
#include "sphparam/baselines/stereographic.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/distortion.h"
#include "support/test_meshes.h"

// stereographic, conformal, flow: three ways to the one conformal map.

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A smooth shape that is no sphere.
TriangleMesh pear(int level) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.position(v);
    mesh.positions.row(v) << p.x() * (1 + 0.4 * p.z()), 0.8 * p.y(), 1.5 * p.z();
  }
  return mesh;
}

double mean_angle_error(const TriangleMesh& mesh, const BaselineResult& result) {
  return summarise(measure_distortion(mesh, *result.map)).mean_abs_ln_angle;
}

double cross_ratio(const Points& x, Vertex a, Vertex b, Vertex c, Vertex d) {
  const auto chord = [&](Vertex p, Vertex q) { return (x.row(p) - x.row(q)).norm(); };
  return chord(a, b) * chord(c, d) / (chord(a, c) * chord(b, d));
}

using Method = BaselineResult (*)(const TriangleMesh&, const Topology&);
const Method by_stereographic = [](const TriangleMesh& mesh, const Topology& topology) {
  return map_stereographic(mesh, topology);
};
const Method by_conformal = [](const TriangleMesh& mesh, const Topology& topology) {
  return map_conformal(mesh, topology, {.least_gain = 1e-10});
};
const Method by_flow = [](const TriangleMesh& mesh, const Topology& topology) {
  return map_flow(mesh, topology, {.roundness = 1e-4});
};

}  // namespace

TEST_CASE(
    "conformal methods: of a smooth shape angles come nearer to the source's as it is refined") {
  for (const Method method : {by_stereographic, by_conformal, by_flow}) {
    double before = 1;
    for (const int level : {2, 3, 4}) {
      const TriangleMesh mesh = pear(level);
      const BaselineResult result = method(mesh, Topology(mesh));
      REQUIRE(result.map);
      CHECK(certify(Topology(mesh), *result.map).bijective());
      const double error = mean_angle_error(mesh, result);
      CHECK(error < 0.7 * before);
      before = error;
    }
    CHECK(before < 0.05);
  }
}

TEST_CASE("stereographic, flow and conformal: the map of a sphere is a Möbius transformation") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  for (const Method method : {by_stereographic, by_conformal, by_flow}) {
    const BaselineResult result = method(mesh, topology);
    REQUIRE(result.map);
    for (Vertex v = 100; v + 900 < mesh.vertex_count(); v += 101) {
      CHECK(cross_ratio(result.map->points, v, v + 300, v + 700, v + 900) ==
            Approx(cross_ratio(mesh.positions, v, v + 300, v + 700, v + 900)).epsilon(0.03));
    }
  }
}

TEST_CASE("stereographic: half of the vertices lie on each hemisphere") {
  const TriangleMesh mesh = pear(3);
  const BaselineResult result = map_stereographic(mesh, Topology(mesh), {.cut = 17});
  const long south = (result.map->points.col(2).array() < 0).count();
  CHECK(std::abs(south - mesh.vertex_count() / 2) <= 1);
  // The triangle that is cut lies around infinity.
  Vector3 middle = Vector3::Zero();
  for (int k = 0; k < 3; ++k) middle += result.map->point(mesh.triangles(17, k));
  CHECK(middle.normalized().z() > 0.99);
}

TEST_CASE("conformal and flow: the centre of mass is zero") {
  const TriangleMesh mesh = pear(3);
  const Eigen::VectorXd mass = vertex_masses(mesh);
  for (const Method method : {by_conformal, by_flow}) {
    const BaselineResult result = method(mesh, Topology(mesh));
    CHECK((result.map->points.transpose() * mass).norm() < 1e-9);
  }
}

TEST_CASE("flow: a sphere is round at once, and stays as it is") {
  const TriangleMesh mesh = icosahedron();
  const BaselineResult result = map_flow(mesh, Topology(mesh));
  CHECK(result.end == BaselineEnd::Converged);
  CHECK(result.iterations == 0);
  CHECK((result.map->points - mesh.positions).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("conformal: the harmonic energy ends near that of a conformal map, 4π") {
  const TriangleMesh mesh = pear(4);
  const BaselineResult result = map_conformal(mesh, Topology(mesh), {.least_gain = 1e-10});
  const size_t at = result.statement.find("energy ");
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(result.statement.substr(at + 7)) == Approx(4 * M_PI).epsilon(0.01));
}

TEST_CASE("conformal: the harmonic energy of a map that moves nothing is the area, 5√3 edges²") {
  const TriangleMesh mesh = icosahedron();
  const BaselineResult result = map_conformal(mesh, Topology(mesh));
  // Eight digits, by no locale; std::to_string has six behind a point or a comma.
  CHECK(result.statement.find("; harmonic energy 9.5745414 (that of") != std::string::npos);
}

TEST_CASE(
    "Möbius centring: a transformation that keeps cross-ratios brings the mass to the centre") {
  const TriangleMesh mesh = icosphere(3);
  SphereMap moved{mesh.positions};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    moved.points.row(v) = mobius_translated(mesh.position(v), Vector3(0.6, -0.5, 0.55));
  }
  const Eigen::VectorXd mass = vertex_masses(mesh);
  CHECK((moved.points.transpose() * mass).norm() > 0.5);
  const SphereMap centred = mobius_centred(moved, mass);
  CHECK((centred.points.transpose() * mass).norm() < 1e-10);
  for (Vertex v = 0; v + 500 < mesh.vertex_count(); v += 13) {
    CHECK(cross_ratio(centred.points, v, v + 90, v + 200, v + 500) ==
          Approx(cross_ratio(mesh.positions, v, v + 90, v + 200, v + 500)).epsilon(1e-6));
  }
}

TEST_CASE("Möbius centring: mass in one point cannot be centred, and is left alone") {
  SphereMap map{Points(4, 3)};
  map.points << 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1;
  const SphereMap same = mobius_centred(map, Eigen::VectorXd::Constant(4, 0.25));
  CHECK(same.points.allFinite());
  CHECK((same.points.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-12);
}
