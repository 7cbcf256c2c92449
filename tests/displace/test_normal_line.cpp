#include <catch2/catch.hpp>
#include <cmath>

#include "displace/normal_line.h"
#include "sphparam/sphere/sphere_locator.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

/// Of a convex polyhedron about the origin with corners on the unit sphere.
double flatness(const TriangleMesh& mesh) {
  double least = 1;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Vector3 a = mesh.position(mesh.triangles(f, 0)), b = mesh.position(mesh.triangles(f, 1)),
                  c = mesh.position(mesh.triangles(f, 2));
    least = std::min(least, (b - a).cross(c - a).normalized().dot(a));
  }
  return least;
}

}  // namespace

TEST_CASE("normal line: from within a ball the way out is walked to from any near face") {
  const TriangleMesh mesh = tests::icosphere(3);
  const Topology topology(mesh);
  const SphereMap map{mesh.positions};
  const SphereLocator locator(topology, map);
  const NormalLines lines(mesh, topology);
  const double inner = flatness(mesh);
  for (Face f = 0; f < mesh.face_count(); f += 7) {
    const Vector3 known = mesh.position(mesh.triangles(f, 0));
    const Vector3 normal = (known + Vector3(0.3, -0.2, 0.25)).normalized();
    const auto crossing = lines.find(0.8 * normal, normal, {f, Vector3::UnitX()});
    CHECK(crossing.hit == LineHit::Walk);
    CHECK(crossing.height > inner - 0.8 - 1e-12);
    CHECK(crossing.height < 0.2 + 1e-12);
    const SurfacePoint there = locator.locate(normal);
    Vector3 point = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      point += there.barycentric[k] * mesh.position(mesh.triangles(there.face, k));
    CHECK((0.8 * normal + crossing.height * normal - point).norm() < 1e-9);
  }
}

TEST_CASE("normal line: outside of a surface the height is negative") {
  const TriangleMesh mesh = tests::icosphere(2);
  const Topology topology(mesh);
  const NormalLines lines(mesh, topology);
  const Vector3 corner = mesh.position(5);
  const auto crossing =
      lines.find(1.5 * corner, corner, {topology.outgoing(5) / 3, Vector3(1, 0, 0)});
  CHECK(crossing.height == Approx(-0.5));
}

TEST_CASE("normal line: a line against the surface takes the nearest crossing there is") {
  const TriangleMesh mesh = tests::icosphere(3);
  const Topology topology(mesh);
  const NormalLines lines(mesh, topology);
  // Just within the top, but the normal points down: the top is met inwards, the bottom far away.
  const auto crossing = lines.find({0.01, 0.02, 0.9}, -Vector3::UnitZ(), {0, Vector3::UnitX()});
  CHECK(crossing.hit == LineHit::Ray);
  CHECK(crossing.height == Approx(-0.1).margin(0.01));
}

TEST_CASE("normal line: one that misses the surface stops where it is nearest") {
  const TriangleMesh mesh = tests::icosphere(4);
  const Topology topology(mesh);
  const NormalLines lines(mesh, topology);
  const auto crossing =
      lines.find({-0.2, 0, 1.1}, Vector3::UnitX(), {0, Vector3(1.0 / 3, 1.0 / 3, 1.0 / 3)});
  CHECK(crossing.hit == LineHit::Near);
  CHECK(crossing.height == Approx(0.2).margin(0.01));
}
