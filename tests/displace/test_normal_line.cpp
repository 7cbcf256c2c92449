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

TEST_CASE("normal line: many at once are found as one by one, of faces alike and not") {
  TriangleMesh mesh = tests::icosphere(3);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 q = mesh.positions.row(v);
    mesh.positions.row(v) *= 1 + 0.3 * std::sin(9 * q.x()) * std::sin(8 * q.y() + 7 * q.z());
  }
  const Topology topology(mesh);
  const NormalLines lines(mesh, topology);
  const size_t count = 2 * static_cast<size_t>(mesh.face_count()) - 3;  // a last run not full
  LineTable table(count);
  PointTable known(count);
  size_t alike = 0;  // lines of the same face
  Face f = -1;
  for (size_t i = 0; i < count; ++i) {
    if (alike-- == 0) alike = static_cast<size_t>(++f % 12);
    known.set(i, {f, Vector3(0.5, 0.3, 0.2)});
    const double share = 0.4 + 0.2 * static_cast<double>(i % 8);  // on both sides of the surface
    const Vector3 point = mesh.position(mesh.triangles(f, 0)),
                  normal =
                      (point + Vector3(0.4, -0.3, 0.1) * static_cast<double>(i % 3)).normalized();
    for (size_t k = 0; k < 3; ++k) {
      table.origins[k][i] = share * point[static_cast<int>(k)];
      table.normals[k][i] = normal[static_cast<int>(k)];
    }
  }
  std::vector<NormalLines::Crossing> crossings(count);
  lines.find_all(table, known, crossings);
  int hits[3] = {};
  for (size_t i = 0; i < count; ++i) {
    const auto one = [i](const std::array<PaddedNumbers, 3>& x) {
      return Vector3(x[0][i], x[1][i], x[2][i]);
    };
    const auto alone = lines.find(one(table.origins), one(table.normals), known[i]);
    CHECK(crossings[i].hit == alone.hit);
    CHECK(crossings[i].height == Approx(alone.height).margin(1e-12));
    ++hits[static_cast<int>(alone.hit)];
  }
  for (const int of_kind : hits) CHECK(of_kind > 10);
}
