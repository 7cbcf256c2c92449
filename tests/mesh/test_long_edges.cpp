#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/triangle_geometry.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double pi = 3.141592653589793;

RepairOptions edges_of(double length) {
  RepairOptions options = RepairOptions::none();
  options.edge_length = length;
  return options;
}

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0;
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.position(mesh.triangles(f, k)) -
                                   mesh.position(mesh.triangles(f, (k + 1) % 3)))
                                      .norm());
  return longest;
}

double least_angle(const TriangleMesh& mesh) {
  double least = pi;
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vector3 at = mesh.position(mesh.triangles(f, k)),
                    u = mesh.position(mesh.triangles(f, (k + 1) % 3)) - at,
                    v = mesh.position(mesh.triangles(f, (k + 2) % 3)) - at;
      least = std::min(least, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
  return least;
}

/// The box (0, 0, 0) to (8, 1, 1), of twelve faces.
TriangleMesh bar() {
  TriangleMesh mesh;
  mesh.positions.resize(8, 3);
  mesh.positions << 0, 0, 0, 8, 0, 0, 8, 1, 0, 0, 1, 0, 0, 0, 1, 8, 0, 1, 8, 1, 1, 0, 1, 1;
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7,
      2, 7, 6, 3, 0, 4, 3, 4, 7;
  return mesh;
}

}  // namespace

TEST_CASE("long edges: none is longer, the surface and its vertices stay") {
  const TriangleMesh mesh = bar();
  const RepairedMesh cut = repair_mesh(mesh, edges_of(0.5));
  CHECK(cut.inspection.is_sphere());
  CHECK(longest_edge(cut.mesh) <= 0.5);
  CHECK(cut.mesh.positions.topRows(8) == mesh.positions);
  CHECK(cut.inspection.area == Approx(34).epsilon(1e-12));
  CHECK(cut.inspection.volume == Approx(8).epsilon(1e-12));
  for (Vertex v = 8; v < cut.mesh.vertex_count(); ++v) {  // on a side: some coordinate is its box's
    const Vector3 p = cut.mesh.position(v);
    CHECK((p.x() == 0 || p.x() == 8 || p.y() == 0 || p.y() == 1 || p.z() == 0 || p.z() == 1));
  }
  CHECK(least_angle(cut.mesh) >= least_angle(mesh) / 2);
  REQUIRE(cut.actions.size() == 1);
  CHECK(cut.actions[0].kind == RepairKind::EdgeHalved);
  CHECK(cut.actions[0].count == static_cast<long>(cut.created.size()));
  CHECK(cut.mesh.face_count() == 12 + 2 * cut.actions[0].count);
}

TEST_CASE("long edges: of six alike each is halved once, and none that is just as long") {
  const TriangleMesh mesh = tetrahedron();
  const double side = longest_edge(mesh);
  CHECK(repair_mesh(mesh, edges_of(side)).actions.empty());
  const RepairedMesh cut = repair_mesh(mesh, edges_of(0.99 * side));
  CHECK(cut.actions.at(0).message == "6 edges halved, longer than asked for");
  CHECK(cut.mesh.face_count() == 16);
}

TEST_CASE("long edges: a share is of the diagonal of the box about the surface") {
  RepairOptions share = RepairOptions::none();
  share.edge_share = 0.5 / std::sqrt(66.0);
  CHECK(repair_mesh(bar(), share).mesh.triangles ==
        repair_mesh(bar(), edges_of(0.5 * (1 + 1e-15))).mesh.triangles);
}

TEST_CASE("long edges: what a created vertex is the mean of says where it lies") {
  const TriangleMesh mesh = bar();
  const RepairedMesh cut = repair_mesh(mesh, edges_of(0.4));
  for (const CreatedVertex& created : cut.created) {
    Vector3 mean = Vector3::Zero();
    double total = 0;
    for (const auto& [vertex, weight] : created.mean_of) {
      mean += weight * mesh.position(vertex);
      total += weight;
    }
    CHECK(mean / total == cut.mesh.position(created.vertex));  // halves and wholes: not rounded
    CHECK(created.mean_of.size() <= 3);
  }
  for (const BlendedCorner& corner : cut.blended) {
    Vector3 at = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      at += corner.between.barycentric[k] * mesh.position(mesh.triangles(corner.between.face, k));
    CHECK(at == cut.mesh.position(cut.mesh.triangles(corner.corner / 3, corner.corner % 3)));
  }
}

TEST_CASE("long edges: what cannot be mapped is left, and what cannot be numbered refused") {
  TriangleMesh open = bar();
  open.triangles.conservativeResize(11, 3);
  CHECK(repair_mesh(open, edges_of(0.5)).actions.empty());
  RepairOptions all;
  all.edge_length = 0.5;
  const RepairedMesh closed = repair_mesh(open, all);  // its hole is filled before
  CHECK(closed.inspection.is_sphere());
  CHECK(longest_edge(closed.mesh) <= 0.5);
  CHECK_THROWS_AS(repair_mesh(bar(), edges_of(1e-5)), std::range_error);
  CHECK_THROWS_AS(repair_mesh(bar(), edges_of(-1)), std::invalid_argument);
}

TEST_CASE("long edges: where a face names no vertex, nothing is measured") {
  TriangleMesh mesh = bar();
  mesh.triangles(3, 1) = 1 << 20;
  RepairOptions share = RepairOptions::none();
  share.edge_share = 0.01;
  const RepairedMesh same = repair_mesh(mesh, share);
  CHECK(same.actions.empty());
  CHECK(same.mesh.triangles == mesh.triangles);
}
