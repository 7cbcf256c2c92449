#include <catch2/catch.hpp>
#include <numbers>

#include "mesh/triangle_geometry.h"

using namespace sphparam;

TEST_CASE("triangle_geometry: angles are exact where they are small, and 0 beside no direction") {
  CHECK(angle_between({1, 0, 0}, {1, 1e-12, 0}) == Approx(1e-12).epsilon(1e-12));
  CHECK(angle_between({1, 0, 0}, {-2, 0, 0}) == std::numbers::pi);
  for (const Vector3& x : {Vector3(1, 2, 3), Vector3(-1, -2, -3), Vector3(0, 0, 0)}) {
    CHECK(angle_between(x, Vector3::Zero()) == 0);
    CHECK(angle_between(-Vector3::Zero(), x) == 0);
  }
}
