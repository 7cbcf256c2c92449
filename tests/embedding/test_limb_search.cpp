#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <utility>
#include <vector>

#include "embedding/twists/limb_search.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

std::vector<Limb> limbs_of(const TriangleMesh& mesh) {
  const Topology topology(mesh);
  LimbSearch search(topology);
  std::vector<Limb> limbs;
  for (Limb limb = search.next(); !limb.empty(); limb = search.next()) limbs.push_back(limb);
  return limbs;
}

/// A tube of three vertices around in place of a face.
TriangleMesh with_limb(const TriangleMesh& mesh, Face f, int rings) {
  const Vertex old_vertices = static_cast<Vertex>(mesh.vertex_count());
  const Face old_faces = static_cast<Face>(mesh.face_count());
  TriangleMesh made = mesh;
  made.positions.conservativeResize(old_vertices + 3 * rings, 3);
  made.triangles.conservativeResize(old_faces + 6 * rings, 3);
  Eigen::RowVector3i below = mesh.triangles.row(f);
  for (int ring = 0; ring < rings; ++ring) {
    const Vertex first = old_vertices + 3 * ring;
    const Eigen::RowVector3i above(first, first + 1, first + 2);
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      made.positions.row(above[k]) = (2 + ring) * mesh.positions.row(mesh.triangles(f, k));
      made.triangles.row(old_faces + 6 * ring + 2 * k) << below[k], below[next], above[next];
      made.triangles.row(old_faces + 6 * ring + 2 * k + 1) << below[k], above[next], above[k];
    }
    below = above;
  }
  made.triangles.row(f) = below;
  return made;
}

}  // namespace

TEST_CASE("limb_search: a tube is one limb, a loop beside the other") {
  for (const auto& [rings, around] : {std::pair{12, 5}, {9, 4}, {25, 12}, {100, 9}}) {
    CAPTURE(rings, around);
    const TriangleMesh mesh = tube(rings, around);
    const Topology topology(mesh);
    const std::vector<Limb> limbs = limbs_of(mesh);
    REQUIRE(limbs.size() == 1);
    CHECK(std::ssize(limbs[0]) == rings);
    std::set<Vertex> seen;
    for (size_t i = 0; i < limbs[0].size(); ++i) {
      const VertexLoop& loop = limbs[0][i];
      REQUIRE(std::ssize(loop) == around);
      for (size_t k = 0; k < loop.size(); ++k) {
        CHECK(seen.insert(loop[k]).second);
        CHECK(topology.find_halfedge(loop[k], loop[(k + 1) % loop.size()]) >= 0);
        if (i == 0) continue;
        CHECK(std::ranges::any_of(
            limbs[0][i - 1], [&](Vertex v) { return topology.find_halfedge(loop[k], v) >= 0; }));
      }
    }
  }
}

TEST_CASE("limb_search: small and plain surfaces have no limbs") {
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), icosphere(3), tube(3, 3)})
    CHECK(limbs_of(mesh).empty());
}

TEST_CASE("limb_search: a limb ends where a vertex of many edges begins") {
  constexpr Vertex hub = 0;
  const TriangleMesh body = uv_sphere(20, 4);
  const auto at_hub = [&](Face f) { return (body.triangles.row(f).array() == hub).any(); };
  Face f = 0;
  while (!at_hub(f)) ++f;
  const std::vector<Limb> limbs = limbs_of(with_limb(body, f, 14));
  REQUIRE(limbs.size() == 1);
  CHECK(limbs[0].size() == 14);
  for (const VertexLoop& loop : limbs[0]) CHECK(std::ranges::count(loop, hub) == 0);
}
