#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <vector>

#include "pipeline/mirrored_pins.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Pins where a turned copy of the map has them, each some way off.
class PinSets {
 public:
  PinSets(const SphereMap& map, unsigned seed) : map_(map), random_(seed) {}

  std::vector<Pin> next(int count, double deviation, bool mirrored) {
    std::vector<Vertex> vertices(static_cast<size_t>(map_.points.rows()));
    std::iota(vertices.begin(), vertices.end(), 0);
    std::shuffle(vertices.begin(), vertices.end(), random_);
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(normal(), normal(), normal(), normal()).normalized().toRotationMatrix();
    std::vector<Pin> pins;
    for (int i = 0; i < count; ++i) {
      const Vertex v = vertices[static_cast<size_t>(i)];
      Vector3 point = turn * map_.point(v);
      if (mirrored) point.y() *= -1;
      point += deviation * Vector3(normal(), normal(), normal());
      pins.push_back({v, point.normalized()});
    }
    return pins;
  }

 private:
  double normal() { return normal_(random_); }

  const SphereMap& map_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

int suspected(const SphereMap& map, int pins, double deviation, bool mirrored) {
  PinSets sets(map, static_cast<unsigned>(pins));
  int told = 0;
  for (int i = 0; i < 200; ++i) {
    told += suspicion_of_mirror(map, sets.next(pins, deviation, mirrored)).has_value();
  }
  return told;
}

}  // namespace

TEST_CASE("mirrored_pins: true pins are not suspected, however far they are off") {
  const SphereMap map{icosphere(4).positions};
  for (const int pins : {1, 2, 3, 4, 5, 10, 50}) {
    for (const double deviation : {0.0, 0.03, 0.1, 0.3, 1.0}) {
      INFO(pins << " pins, " << deviation);
      CHECK(suspected(map, pins, deviation, false) <= (deviation > 0 && pins > 2 ? 1 : 0));
    }
  }
}

TEST_CASE("mirrored_pins: mirrored ones are, the more of them the farther they may be off") {
  const SphereMap map{icosphere(4).positions};
  for (const int pins : {4, 5, 10, 50}) {
    INFO(pins << " pins");
    CHECK(suspected(map, pins, 0.0, true) == 200);
    CHECK(suspected(map, pins, 0.03, true) >= 190);
  }
  CHECK(suspected(map, 10, 0.1, true) == 200);
  CHECK(suspected(map, 50, 0.3, true) == 200);
}

TEST_CASE("mirrored_pins: pins on a great circle leave open which it is") {
  const SphereMap map{uv_sphere(24, 11).positions};
  std::vector<Pin> pins;
  for (Vertex v = 0; v < map.points.rows(); ++v) {
    Vector3 point = map.point(v);
    if (std::abs(point.z()) > 1e-9) continue;
    pins.push_back({v, point});
  }
  REQUIRE(pins.size() == 24);
  CHECK_FALSE(suspicion_of_mirror(map, pins));
}

TEST_CASE("parameterize: mirrored pins are warned of, and true ones are not") {
  const TriangleMesh mesh = random_sphere_mesh(1000, 5);
  const SphereMap map = parameterize(mesh, {.automatic_poles = false}).map;
  for (const bool mirrored : {false, true}) {
    ParameterizeOptions options;
    for (const Vertex v : {10, 200, 333, 555, 777, 999}) {
      SphericalCoordinates coordinates = to_spherical(map.point(v));
      if (mirrored) coordinates.theta = -coordinates.theta;
      options.pins.push_back({v, coordinates});
    }
    const std::vector<std::string> warnings = parameterize(mesh, options).warnings;
    const bool warned = std::ranges::any_of(warnings, [](const std::string& warning) {
      return warning.starts_with("the pins look mirrored");
    });
    CHECK(warned == mirrored);
  }
}
