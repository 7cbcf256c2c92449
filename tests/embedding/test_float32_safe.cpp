#include <catch2/catch.hpp>

#include "embedding/constructions/float32_safe.h"
#include "embedding/frame/landmarks.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

bool is_float(const SphereMap& map) {
  return (map.points.array() == map.points.cast<float>().cast<double>().array()).all();
}

/// A Möbius transformation of a sphere's points: all but the first nearer to its antipode than the
/// spacing of floats.
SphereMap gathered_map(const TriangleMesh& sphere) {
  constexpr double scale = 1e-8;
  const Vector3 pole = -sphere.position(0);
  SphereMap map{sphere.positions};
  for (Vertex v = 1; v < sphere.vertex_count(); ++v) {
    const Vector3 p = sphere.position(v);
    const Vector3 plane = scale / (1 + p.dot(pole)) * (p - p.dot(pole) * pole);
    map.points.row(v) = (2 * plane + (1 - plane.squaredNorm()) * pole).normalized();
  }
  return map;
}

}  // namespace

TEST_CASE("What rounding folds though nudged is mapped anew, certified in float32") {
  const TriangleMesh mesh = gathered_sphere();
  const Topology topology(mesh);
  const SphereMap map = gathered_map(icosphere(5));
  REQUIRE(certify(topology, map).bijective());
  REQUIRE_FALSE(round_to_float(topology, map).certificate.bijective());
  const Float32SafeRounding safe = round_float32_safe(mesh, topology, map);
  CHECK(certify(topology, safe.rounding.map).bijective());
  CHECK(is_float(safe.rounding.map));
  CHECK(safe.least_area > 0);
  // Turned as the map was.
  const Eigen::Matrix3d rest = best_rotation(safe.rounding.map.points, map.points);
  CHECK((rest - Eigen::Matrix3d::Identity()).norm() < 1e-4);
}

TEST_CASE("float32_safe: the same bytes for any number of threads") {
  const TriangleMesh mesh = gathered_sphere();
  const Topology topology(mesh);
  const SphereMap map = gathered_map(icosphere(5));
  CHECK(round_float32_safe(mesh, topology, map, {.threads = 1}).rounding.map.points ==
        round_float32_safe(mesh, topology, map, {.threads = 4}).rounding.map.points);
}

TEST_CASE("A map that floats can hold is rounded and nothing more") {
  const TriangleMesh sphere = icosphere(3);
  const Topology topology(sphere);
  const Float32SafeRounding safe = round_float32_safe(sphere, topology, {sphere.positions});
  CHECK(safe.least_area == 0);
  CHECK(safe.rounding.map.points == round_to_float(topology, {sphere.positions}).map.points);
}

TEST_CASE("A folded map is rounded and stays folded") {
  const TriangleMesh sphere = icosphere(2);
  SphereMap folded{sphere.positions};
  folded.points.row(0) = -folded.points.row(0).eval();
  const Float32SafeRounding safe = round_float32_safe(sphere, Topology(sphere), folded);
  CHECK(safe.least_area == 0);
  CHECK_FALSE(safe.rounding.certificate.bijective());
}
