#include <catch2/catch.hpp>
#include <limits>
#include <stdexcept>

#include "sphparam/sphere/float_rounding.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// The sphere with one cap, about a direction that favours no axis, shrunk by a factor.
SphereMap with_small_cap(const TriangleMesh& sphere, double factor) {
  const Vector3 centre = Vector3(0.37, -0.61, 0.70).normalized();
  constexpr double cosine = 0.95;
  Points rays = sphere.positions;
  for (Eigen::Index v = 0; v < rays.rows(); ++v) {
    const Vector3 x = rays.row(v);
    if (x.dot(centre) > cosine) rays.row(v) = centre + factor * (x - centre);
  }
  return normalised(std::move(rays));
}

bool is_float(const SphereMap& map) {
  const Eigen::MatrixXf floats = map.points.cast<float>();
  return map.points == floats.cast<double>();
}

}  // namespace

TEST_CASE("float_rounding: a map with room in every triangle gets its nearest floats") {
  const TriangleMesh sphere = icosphere(5);
  const Topology topology(sphere);
  const FloatRounding rounding = round_to_float(topology, {sphere.positions});
  CHECK((rounding.map.points - sphere.positions).cwiseAbs().maxCoeff() <= 0x1p-25);
  CHECK(rounding.certificate.bijective());
  CHECK(rounding.bad_before == 0);
  CHECK(rounding.bad_after == 0);
  CHECK(rounding.moved == 0);
}

TEST_CASE(
    "float_rounding: triangles that fold in float32 are mended, the others keep their floats") {
  const TriangleMesh sphere = icosphere(5);
  const Topology topology(sphere);
  for (const double factor : {1e-6, 1e-7, 1e-9, 1e-12}) {
    const SphereMap map = with_small_cap(sphere, factor);
    INFO("cap shrunk by " << factor);
    REQUIRE(certify(topology, map).bijective());
    const FloatRounding rounding = round_to_float(topology, map);
    CHECK(rounding.bad_before > 0);
    CHECK(rounding.bad_after == 0);
    CHECK(rounding.certificate.bijective());
    CHECK(is_float(rounding.map));
    CHECK(rounding.moved > 0);
    CHECK(rounding.moved < topology.vertex_count() / 10);
  }
}

TEST_CASE("float_rounding: a sphere of another radius is certified in the numbers it has there") {
  const TriangleMesh sphere = icosphere(5);
  const Topology topology(sphere);
  for (const double radius : {100.0, 0.3}) {
    const FloatRounding plain = round_to_float(topology, {sphere.positions}, 0, radius);
    CHECK(is_float(plain.map));
    CHECK((plain.map.points - radius * sphere.positions).cwiseAbs().maxCoeff() <= radius * 0x1p-24);
    for (const double factor : {1e-6, 1e-9}) {
      const FloatRounding rounding =
          round_to_float(topology, with_small_cap(sphere, factor), 0, radius);
      CHECK(rounding.bad_before > 0);
      CHECK(rounding.bad_after == 0);
      CHECK(certify(topology, rounding.map).bijective());
      CHECK(is_float(rounding.map));
      CHECK((rounding.map.points.rowwise().norm().array() / radius - 1).abs().maxCoeff() < 1e-6);
    }
  }
  for (const double radius : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(round_to_float(topology, {sphere.positions}, 0, radius), std::invalid_argument);
  CHECK_THROWS_AS(round_to_float(topology, {}), std::invalid_argument);
}

TEST_CASE("float_rounding: one flat triangle costs one vertex a few ulps, not a smoothing") {
  const TriangleMesh sphere = icosphere(3);
  const Topology topology(sphere);
  SphereMap map{sphere.positions};
  // Vertex a of a face falls onto the opposite side, but for less than a float can tell.
  const Vertex a = topology.vertex(0, 0), b = topology.vertex(0, 1), c = topology.vertex(0, 2);
  FloatRounding rounding;
  for (double share = 0.3; share < 0.7 && rounding.bad_before == 0; share += 0.01) {
    const Vector3 side = share * map.point(b) + (1 - share) * map.point(c);
    map.points.row(a) = (side + 1e-10 * (sphere.position(a) - side)).normalized();
    REQUIRE(certify(topology, map).bijective());
    rounding = round_to_float(topology, map);
  }
  CHECK(rounding.bad_before == 1);
  CHECK(rounding.certificate.bijective());
  CHECK(rounding.moved == 1);
  CHECK((rounding.map.points - map.points).cwiseAbs().maxCoeff() < 9 * 0x1p-24);
}

TEST_CASE("float_rounding: a folded map is rounded and stays as folded as it is") {
  const TriangleMesh sphere = icosphere(2);
  const Topology topology(sphere);
  SphereMap map{sphere.positions};
  map.points.row(0) = -map.points.row(0);
  const FloatRounding rounding = round_to_float(topology, map);
  CHECK(is_float(rounding.map));
  CHECK(rounding.moved == 0);
  CHECK(rounding.bad_after == certify(topology, map).fold_count());
  CHECK_FALSE(rounding.certificate.bijective());
}

TEST_CASE("float_rounding: a double cover is never certified, however positive") {
  const TriangleMesh sphere = uv_sphere(12, 5);
  const FloatRounding rounding = round_to_float(Topology(sphere), {wound_rays(12, 5, 2)});
  CHECK(rounding.bad_after == 0);
  CHECK(rounding.certificate.degree == 2);
  CHECK_FALSE(rounding.certificate.bijective());
}

TEST_CASE("float_rounding: same bytes for any number of threads") {
  const TriangleMesh sphere = icosphere(5);
  const Topology topology(sphere);
  const SphereMap map = with_small_cap(sphere, 1e-7);
  CHECK(round_to_float(topology, map, 1).map.points == round_to_float(topology, map, 4).map.points);
}
