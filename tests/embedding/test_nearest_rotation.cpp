#include <catch2/catch.hpp>

#include "embedding/frame/nearest_rotation.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

Eigen::Matrix3d rotation(double angle) {
  return Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
}

}  // namespace

TEST_CASE("nearest_rotation: finds the rotation that was applied, never a reflection") {
  const SphereMap map{icosphere(2).positions};
  const VectorX even = VectorX::Ones(map.points.rows());
  for (const double angle : {0.0, 1e-6, 1.0, 3.1}) {
    const SphereMap there = turned(map, rotation(angle));
    CHECK((nearest_rotation(map.points, there.points, even) - rotation(angle)).norm() < 1e-14);
    CHECK(rms_angle(map, there, even) == Approx(rms_angle(there, map, even)));
  }
  const Points mirrored = -map.points;
  CHECK(nearest_rotation(map.points, mirrored, even).determinant() == Approx(1));
}

TEST_CASE("nearest_rotation: what weighs nothing has no say") {
  SphereMap map{icosphere(2).positions};
  SphereMap there = turned(map, rotation(0.7));
  VectorX weights = VectorX::Ones(map.points.rows());
  for (Vertex v = 0; v < 60; ++v) {
    weights[v] = 0;
    there.points.row(v) = Vector3::UnitX();
  }
  CHECK((nearest_rotation(map.points, there.points, weights) - rotation(0.7)).norm() < 1e-14);
  CHECK(rms_angle(turned(map, rotation(0.7)), there, weights) < 1e-15);
}

TEST_CASE("rms_angle: of maps turned about an axis it is what the law of large meshes says") {
  // Points of the whole sphere turned by a small angle move by its sine to the axis: mean 2/3.
  const SphereMap map{icosphere(4).positions};
  const VectorX even = VectorX::Ones(map.points.rows());
  CHECK(rms_angle(map, turned(map, rotation(1e-3)), even) ==
        Approx(1e-3 * std::sqrt(2.0 / 3)).epsilon(1e-3));
}
