#include <catch2/catch.hpp>
#include <numbers>

#include "sphere/solid_angle.h"
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
