#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "sphere/solid_angle.h"
#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double cap_height = 0.9;
const Vector3 cap_centre = Vector3(0.37, -0.61, 0.70).normalized();

bool is_in_cap(const TriangleMesh& sphere, Vertex v) {
  return sphere.position(v).dot(cap_centre) > cap_height;
}

/// The sphere with one cap, about a direction that favours no axis, shrunk by a factor.
SphereMap with_small_cap(const TriangleMesh& sphere, double factor) {
  Points rays = sphere.positions;
  for (Vertex v = 0; v < rays.rows(); ++v) {
    const Vector3 x = rays.row(v);
    if (is_in_cap(sphere, v)) rays.row(v) = cap_centre + factor * (x - cap_centre);
  }
  return normalised(std::move(rays));
}

}  // namespace

TEST_CASE(
    "solid_angle: shares of vertices sum to the sphere, those of the smallest are exact too") {
  const TriangleMesh sphere = icosphere(4);
  const Topology topology(sphere);
  const VectorX tiny = vertex_solid_angles(topology, with_small_cap(sphere, 0x1p-30)),
                small = vertex_solid_angles(topology, with_small_cap(sphere, 0x1p-20));
  for (const VectorX& shares : {tiny, small}) {
    CHECK(shares.sum() == Approx(4 * std::numbers::pi).epsilon(1e-12));
    CHECK(shares.minCoeff() > 0);
  }
  int inside = 0;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    bool surrounded = is_in_cap(sphere, v);
    topology.for_each_outgoing(
        v, [&](Halfedge h) { surrounded = surrounded && is_in_cap(sphere, topology.target(h)); });
    if (!surrounded) continue;
    ++inside;
    CHECK(tiny[v] / small[v] == Approx(0x1p-20).epsilon(1e-5));  // as flat as the other
  }
  CHECK(inside > 50);
}

TEST_CASE("solid_angle: a triangle of next to half the sphere has the sign that it has exactly") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const TriangleMesh sphere = tetrahedron();
  const Topology topology(sphere);
  int certified = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3 up = Vector3(normal(random), normal(random), normal(random)).normalized();
    const Vector3 right = up.unitOrthogonal(), ahead = up.cross(right);
    SphereMap map{sphere.positions};
    for (int k = 0; k < 3; ++k) {  // about the circle of its first face, whose other side `down` is
      const double at = 2 * std::numbers::pi / 3 * k;
      map.points.row(topology.vertex(0, k)) =
          (std::cos(at) * right + std::sin(at) * ahead).normalized();
    }
    map.points.row(6 - topology.vertex(0, 0) - topology.vertex(0, 1) - topology.vertex(0, 2)) = -up;
    if (!certify(topology, map).bijective()) continue;
    ++certified;
    CHECK(vertex_solid_angles(topology, map).sum() == Approx(4 * std::numbers::pi).epsilon(1e-12));
  }
  CHECK(certified > 50);
}

TEST_CASE("solid_angle: corners that are nearly opposite leave the shares what they are") {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Vector3(normal(random), normal(random), normal(random)).normalized().eval();
  };
  const TriangleMesh sphere = tetrahedron();
  const Topology topology(sphere);
  int certified = 0;
  for (int i = 0; i < 500; ++i) {
    SphereMap map{Points(4, 3)};
    for (int v = 0; v < 4; ++v) map.points.row(v) = direction();
    map.points.row(1) = (-map.point(0) + std::ldexp(1.0, -i % 52) * direction()).normalized();
    if (!certify(topology, map).bijective()) continue;
    ++certified;
    CHECK(vertex_solid_angles(topology, map).sum() == Approx(4 * std::numbers::pi).epsilon(1e-12));
    CHECK(vertex_solid_angles(topology, map).minCoeff() > 0);
  }
  CHECK(certified > 20);
}
