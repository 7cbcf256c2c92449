#include <catch2/catch.hpp>

#include "embedding/constructions/float32_safe.h"
#include "embedding/frame/landmarks.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

bool is_float(const SphereMap& map) {
  return (map.points.array() == map.points.cast<float>().cast<double>().array()).all();
}

}  // namespace

TEST_CASE("What rounding folds though nudged is mapped anew, certified in float32") {
  const TriangleMesh mesh = gathered_sphere();
  const Topology topology(mesh);
  const SphereMap map = parameterize(mesh).map;
  REQUIRE(certify(topology, map).bijective());
  REQUIRE_FALSE(round_to_float(topology, map).certificate.bijective());
  const RoomyRounding roomy = round_with_room(mesh, topology, map);
  CHECK(certify(topology, roomy.rounding.map).bijective());
  CHECK(is_float(roomy.rounding.map));
  CHECK(roomy.least_area > 0);
  // Turned as the map was.
  const Eigen::Matrix3d rest = best_rotation(roomy.rounding.map.points, map.points);
  CHECK((rest - Eigen::Matrix3d::Identity()).norm() < 1e-4);
}

TEST_CASE("Room is made the same for any number of threads") {
  const TriangleMesh mesh = gathered_sphere();
  const Topology topology(mesh);
  const SphereMap map = parameterize(mesh).map;
  CHECK(round_with_room(mesh, topology, map, {.threads = 1}).rounding.map.points ==
        round_with_room(mesh, topology, map, {.threads = 4}).rounding.map.points);
}

TEST_CASE("A map that floats can hold is rounded and nothing more") {
  const TriangleMesh sphere = icosphere(3);
  const Topology topology(sphere);
  const RoomyRounding roomy = round_with_room(sphere, topology, {sphere.positions});
  CHECK(roomy.least_area == 0);
  CHECK(roomy.rounding.map.points == round_to_float(topology, {sphere.positions}).map.points);
}

TEST_CASE("A folded map is rounded and stays folded") {
  const TriangleMesh sphere = icosphere(2);
  SphereMap folded{sphere.positions};
  folded.points.row(0) = -folded.points.row(0).eval();
  const RoomyRounding roomy = round_with_room(sphere, Topology(sphere), folded);
  CHECK(roomy.least_area == 0);
  CHECK_FALSE(roomy.rounding.certificate.bijective());
}
