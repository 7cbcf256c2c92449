#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "embedding/sweeps/kernel_placement.h"
#include "sphparam/sphere/orientation.h"

using namespace sphparam;

namespace {

/// A simple polygon of the sphere, and whether the point sees all of its edges.
bool sees(const std::vector<Vector3>& ring, const Vector3& x) {
  for (size_t i = 0; i < ring.size(); ++i) {
    if (orientation(x, ring[i], ring[(i + 1) % ring.size()]) <= 0) return false;
  }
  return true;
}

/// Around a point on the equator, star-shaped as seen from it: heights above and below the equator
/// are `thickness` times their extent along it.
std::vector<Vector3> sliver(std::mt19937& random, int corners, double thickness) {
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<double> angle;
  for (int i = 0; i < corners; ++i) {
    angle.push_back(2 * std::numbers::pi * (i + 0.8 * uniform()) / corners);
  }
  std::vector<Vector3> ring;
  for (const double a : angle) {
    const double r = 0.2 + 0.8 * uniform();
    const double along = r * std::cos(a), height = thickness * r * std::sin(a);
    ring.emplace_back(Vector3(std::cos(along), std::sin(along), height).normalized());
  }
  return ring;
}

}  // namespace

TEST_CASE("place_in_kernel: finds room in slivers down to a hundred thousandth of a millionth") {
  std::mt19937 random(7);
  int with_room = 0, found = 0;
  for (int round = 0; round < 4000; ++round) {
    const double thickness = std::pow(10.0, -(round % 12));
    const std::vector<Vector3> ring = sliver(random, 4 + round % 5, thickness);
    if (!sees(ring, Vector3::UnitX())) continue;  // gaps above π
    ++with_room;
    const auto point = place_in_kernel(ring);
    found += point && sees(ring, *point);
  }
  CHECK(with_room > 1500);
  CHECK(found == with_room);
}

TEST_CASE("place_in_kernel: a ring of four within 1e-10 of a great circle") {
  const std::vector<Vector3> ring{{0.035735490084023415, -0.7623599868316423, -0.64616578772518807},
                                  {0.13518912119244328, -0.98770147495621208, 0.078547424404231417},
                                  {0.15946809621860641, -0.77741000788614789, 0.60844359305269469},
                                  {0.1470053949522204, -0.96043351628291795, 0.23655205485341252}};
  const auto point = place_in_kernel(ring);
  REQUIRE(point);
  CHECK(sees(ring, *point));
}

TEST_CASE("place_in_kernel: no point where there is none") {
  // A star with three thin arms and the corners between them pushed past the centre.
  std::vector<Vector3> ring;
  for (int i = 0; i < 6; ++i) {
    const double a = std::numbers::pi * (i + (i % 2 ? 1.4 : 0)) / 3, r = i % 2 ? 0.35 : 0.4;
    ring.emplace_back(Vector3(r * std::cos(a), r * std::sin(a), 1).normalized());
  }
  CHECK_FALSE(place_in_kernel(ring));
}
