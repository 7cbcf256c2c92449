#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "sphparam/sphere/sphere_map.h"
#include "sphparam/sphere/spherical_coordinates.h"

using namespace sphparam;

TEST_CASE("spherical_coordinates: the axes lie where the convention says") {
  constexpr double pi = std::numbers::pi;
  const auto check = [](const Vector3& ray, double theta, double phi) {
    CHECK(to_spherical(ray).theta == Approx(theta).margin(1e-15));
    CHECK(to_spherical(ray).phi == Approx(phi).margin(1e-15));
  };
  check({1, 0, 0}, 0, pi / 2);
  check({0, 1, 0}, pi / 2, pi / 2);
  check({-1, 0, 0}, pi, pi / 2);
  check({0, -1, 0}, 3 * pi / 2, pi / 2);
  check({0, 0, 1}, 0, 0);
  check({0, 0, -1}, 0, pi);
  check({-0.0, 0.0, 1}, 0, 0);
}

TEST_CASE("spherical_coordinates: there and back is the identity, and the ranges hold") {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 10000; ++i) {
    const Vector3 ray = Vector3(normal(random), normal(random), normal(random)).normalized();
    const SphericalCoordinates c = to_spherical(17.5 * ray);
    REQUIRE(c.theta >= 0);
    REQUIRE(c.theta < 2 * std::numbers::pi);
    REQUIRE(c.phi >= 0);
    REQUIRE(c.phi <= std::numbers::pi);
    // θ and ϕ near 2π and π are rounded by up to 4.4e-16; sine and cosine add their own.
    REQUIRE((to_cartesian(c) - ray).norm() < 1.5e-15);
  }
}

TEST_CASE("spherical_coordinates: an angle just below zero does not become two pi") {
  const SphericalCoordinates c = to_spherical({1, -1e-300, 0});
  CHECK(c.theta < 2 * std::numbers::pi);
}

TEST_CASE("sphere_map: rays of any length are brought to length one") {
  Points rays(3, 3);
  rays << 3, 4, 0, 1e-300, 1e-300, 0, 0, 1e300, 1e300;
  const SphereMap map = normalised(rays);
  for (int v = 0; v < 3; ++v) CHECK(map.point(v).norm() == Approx(1).epsilon(1e-15));
}
