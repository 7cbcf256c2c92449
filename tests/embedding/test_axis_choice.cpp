#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "embedding/constructions/progressive.h"
#include "embedding/frame/axis_choice.h"
#include "folded_maps.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/rotation.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double pi = std::numbers::pi;

SphereMap turned_to(const SphereMap& map, const Vector3& axis) {
  return {map.points * rotation_between(axis, Vector3::UnitZ()).transpose()};
}

long chart_folds(const Topology& topology, const SphereMap& map) {
  long folds = 0;
  for (Face f = 0; f < topology.face_count(); ++f) {
    folds += folds_in_chart(map.point(topology.vertex(f, 0)), map.point(topology.vertex(f, 1)),
                            map.point(topology.vertex(f, 2)));
  }
  return folds;
}

/// Half-edges that cross the half-circle at θ eastwards: one a triangle that it crosses.
long crossed_by(const Topology& topology, const SphereMap& map, double theta) {
  const Vector3 front(std::cos(theta), std::sin(theta), 0), side(-front.y(), front.x(), 0);
  const auto east = [&](Vertex v) {
    const Vector3 x = map.point(v);
    return std::atan2(x.dot(side), x.dot(front));
  };
  long crossed = 0;
  for (Face f = 0; f < topology.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const double from = east(topology.vertex(f, k)), to = east(topology.vertex(f, (k + 1) % 3));
      crossed += from < 0 && to >= 0 && to - from < pi;
    }
  }
  return crossed;
}

}  // namespace

TEST_CASE("folds_in_chart: a low triangle south of its long edge folds, one north of it does not") {
  const auto at = [](double theta, double phi) { return to_cartesian({theta, phi}); };
  // The great circle between the ends passes north of the parallel: an apex between the two lies
  // south of the one and north of the other.
  const Vector3 west = at(-0.5, 0.6), east = at(0.5, 0.6);
  const double top = to_spherical(west + east).phi;
  REQUIRE(top < 0.6);
  const Vector3 between = at(0, (top + 0.6) / 2);
  REQUIRE(orientation(west, between, east) > 0);
  CHECK(folds_in_chart(west, between, east));
  CHECK_FALSE(folds_in_chart(west, at(0, 0.7), east));
  CHECK_FALSE(folds_in_chart(east, at(0, top - 0.01), west));
}

TEST_CASE("folds_in_chart: nothing folds at the date line, around a pole or touching it") {
  const auto at = [](double theta, double phi) { return to_cartesian({theta, phi}); };
  CHECK_FALSE(folds_in_chart(at(pi - 0.1, 1.6), at(pi + 0.1, 1.6), at(pi, 1.5)));
  CHECK_FALSE(folds_in_chart(at(0, 0.1), at(2, 0.1), at(4, 0.1)));
  CHECK_FALSE(folds_in_chart(Vector3::UnitZ(), at(0, 0.1), at(1, 0.1)));
}

TEST_CASE("choose_axis: finds the axis that makes texels even, wherever it points") {
  const TriangleMesh sphere = icosphere(4);
  const Topology topology(sphere);
  for (const Vector3& wanted : {Vector3(0, 0, 1), Vector3(1, 2, -3), Vector3(-5, 1, 1)}) {
    const Vector3 d = wanted.normalized();
    // A lens with axis d: its faces are shown small, its rim large, as 1/sin ϕ has it.
    TriangleMesh lens = sphere;
    lens.positions -= 0.7 * (sphere.positions * d) * d.transpose();
    const AxisChoice choice = choose_axis(topology, measure_source(lens), {sphere.positions});
    CHECK(std::abs(choice.axis.dot(d)) > std::cos(0.2));
    CHECK(choice.density_spread < 0.8 * choice.mean_density_spread);
    CHECK(choice.axis.norm() == Approx(1));
  }
}

TEST_CASE("choose_axis: folds less than the average axis, all triangles counted") {
  // Needles along meridians: they fold where they pass a pole of the chart sideways.
  const TriangleMesh mesh = uv_sphere(200, 8);
  const Topology topology(mesh);
  const SphereMap map = normalised(mesh.positions);
  const AxisChoice choice = choose_axis(topology, measure_source(mesh), map);
  const long chosen = chart_folds(topology, turned_to(map, choice.axis));
  double mean = 0;
  for (int k = 0; k < 40; ++k) {
    const Vector3 axis = to_cartesian({2.4 * k, std::acos((k + 0.5) / 40)});
    mean += static_cast<double>(chart_folds(topology, turned_to(map, axis))) / 40;
  }
  CHECK(static_cast<double>(chosen) < 0.5 * mean);
  CHECK(choice.folds < 0.5 * choice.mean_folds);
  CHECK(choice.mean_folds == Approx(mean).epsilon(0.2));
}

TEST_CASE("choose_axis: what it says of folds is what the chart does") {
  const TriangleMesh mesh = random_sphere_mesh(600, 5);
  const Topology topology(mesh);
  const SphereMap map = *embed_progressively(mesh, topology).map;
  const AxisChoice choice = choose_axis(topology, measure_source(mesh), map);
  const long folds = chart_folds(topology, turned_to(map, choice.axis));
  CHECK(std::abs(choice.folds - static_cast<double>(folds)) <= 3);
}

TEST_CASE("choose_meridian: the best of its 256 half-circles, hardly worse than the best of more") {
  const TriangleMesh mesh = random_sphere_mesh(800, 9);
  const Topology topology(mesh);
  const SphereMap map = *embed_progressively(mesh, topology).map;
  const double theta = choose_meridian(topology, map);
  CHECK(theta >= 0);
  CHECK(theta < 2 * pi);
  // They are even round the square |x| + |y| = 1.
  long own_best = topology.face_count(), best = own_best;
  for (int k = 0; k < 64; ++k) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double longitude = std::atan2(k, 64 - k) + quarter * pi / 2;
      own_best = std::min(own_best, crossed_by(topology, map, longitude));
    }
  }
  for (int k = 0; k < 500; ++k) best = std::min(best, crossed_by(topology, map, 2 * pi * k / 500));
  const long crossed = crossed_by(topology, map, theta);
  CHECK(crossed == own_best);
  CHECK(crossed <= best + 4);
}

TEST_CASE("axis choice: the same for any number of threads") {
  const TriangleMesh mesh = icosphere(5);
  const Topology topology(mesh);
  const SphereMap map = with_noise({mesh.positions}, 0.005, 4);
  const RestTriangles source = measure_source(mesh);
  const AxisChoice one = choose_axis(topology, source, map, {.threads = 1});
  const AxisChoice three = choose_axis(topology, source, map, {.threads = 3});
  CHECK(one.axis == three.axis);
  CHECK(one.density_spread == three.density_spread);
  CHECK(choose_meridian(topology, map, 1) == choose_meridian(topology, map, 3));
}
