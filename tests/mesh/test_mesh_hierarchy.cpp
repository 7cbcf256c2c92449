#include <array>
#include <catch2/catch.hpp>
#include <set>
#include <utility>

#include "mesh/mesh_hierarchy.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

TriangleMesh some_mesh(int which) {
  switch (which) {
    case 0:
      return tetrahedron();
    case 1:
      return icosphere(3);
    case 2:
      return tube(50, 5);
    case 3:
      return uv_sphere(400, 1);
    default:
      return random_sphere_mesh(500, 3);
  }
}

/// Every ring is a cycle of different neighbours, every edge is seen from both ends, and x, y
/// follow each other around v exactly when y, v follow each other around x.
void require_triangulation(const HierarchyLevel& level) {
  std::set<std::pair<Vertex, Vertex>> edges;
  std::set<std::array<Vertex, 3>> faces;
  for (Vertex v = 0; v < level.vertex_count(); ++v) {
    const int k = level.valence(v);
    REQUIRE(k >= 3);
    for (int i = 0; i < k; ++i) {
      const Vertex x = level.ring_begin(v)[i], y = level.ring_begin(v)[(i + 1) % k];
      REQUIRE(edges.insert({v, x}).second);
      faces.insert({v, x, y});
    }
  }
  for (const auto& [a, b] : edges) REQUIRE(edges.contains({b, a}));
  for (const auto& [a, b, c] : faces) REQUIRE(faces.contains({b, c, a}));
  const long euler = level.vertex_count() - static_cast<long>(edges.size()) / 2 +
                     static_cast<long>(faces.size()) / 3;
  CHECK(euler == 2);
}

MeshHierarchy complete(MeshHierarchy hierarchy) {
  for (size_t l = hierarchy.size() - 1; l-- > 0;) {
    complete_positions(hierarchy[l], hierarchy[l + 1]);
  }
  return hierarchy;
}

}  // namespace

TEST_CASE("mesh_hierarchy: positions are the mesh's own, centred and scaled to area 4π") {
  const TriangleMesh mesh = tube(50, 5);
  const MeshHierarchy hierarchy = complete(build_hierarchy(mesh, Topology(mesh)));
  const Points& positions = hierarchy.front().positions;
  REQUIRE(positions.rows() == mesh.vertex_count());
  const double scale = (positions.row(1) - positions.row(0)).norm() /
                       (mesh.positions.row(1) - mesh.positions.row(0)).norm();
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 expected = scale * (mesh.position(v) - mesh.position(0));
    CHECK((positions.row(v) - positions.row(0) - expected.transpose()).norm() < 1e-12);
  }
}

TEST_CASE("mesh_hierarchy: a position is stored once, whatever the number of levels") {
  const TriangleMesh mesh = icosphere(5);
  Eigen::Index stored = 0;
  for (const HierarchyLevel& level : build_hierarchy(mesh, Topology(mesh))) {
    stored += level.positions.rows();
  }
  CHECK(stored == mesh.vertex_count());
}

TEST_CASE("mesh_hierarchy: every level is a triangulation of the sphere, the last a tetrahedron") {
  const TriangleMesh mesh = some_mesh(GENERATE(0, 1, 2, 3, 4));
  const MeshHierarchy hierarchy = build_hierarchy(mesh, Topology(mesh));
  CHECK(hierarchy.front().vertex_count() == mesh.vertex_count());
  CHECK(hierarchy.back().vertex_count() == 4);
  for (const HierarchyLevel& level : hierarchy) require_triangulation(level);
}

TEST_CASE(
    "mesh_hierarchy: removed vertices are independent, and the others keep names and places") {
  const TriangleMesh mesh = some_mesh(GENERATE(1, 2, 3, 4));
  const MeshHierarchy hierarchy = complete(build_hierarchy(mesh, Topology(mesh)));
  for (size_t l = 0; l + 1 < hierarchy.size(); ++l) {
    const HierarchyLevel &fine = hierarchy[l], &coarse = hierarchy[l + 1];
    const std::set<Vertex> removed(fine.removed.begin(), fine.removed.end());
    CHECK(coarse.vertex_count() + static_cast<int>(removed.size()) == fine.vertex_count());
    for (const Vertex v : removed) {
      for (int i = 0; i < fine.valence(v); ++i)
        REQUIRE_FALSE(removed.contains(fine.ring_begin(v)[i]));
    }
    for (Vertex v = 0; v < coarse.vertex_count(); ++v) {
      const Vertex name = coarse.finer[static_cast<size_t>(v)];
      REQUIRE_FALSE(removed.contains(name));
      REQUIRE(coarse.positions.row(v) == fine.positions.row(name));
    }
  }
}

TEST_CASE("mesh_hierarchy: a level as a mesh has its places, and its rings the same way round") {
  const TriangleMesh mesh = some_mesh(GENERATE(0, 1, 2, 4));
  for (const HierarchyLevel& level : complete(build_hierarchy(mesh, Topology(mesh)))) {
    const TriangleMesh as_mesh = triangle_mesh(level);
    CHECK(as_mesh.positions == level.positions);
    CHECK(as_mesh.face_count() == 2 * level.vertex_count() - 4);
    const Topology topology(as_mesh);
    for (Vertex v = 0; v < level.vertex_count(); ++v) {
      const int k = level.valence(v);
      for (int i = 0; i < k; ++i) {
        const Halfedge h = topology.find_halfedge(v, level.ring_begin(v)[i]);
        REQUIRE(h >= 0);
        REQUIRE(topology.apex(h) == level.ring_begin(v)[(i + 1) % k]);
      }
    }
  }
}

TEST_CASE("mesh_hierarchy: the same levels for 1, 2 and 4 threads") {
  const TriangleMesh mesh = icosphere(5);
  const Topology topology(mesh);
  const MeshHierarchy one = build_hierarchy(mesh, topology, 1);
  for (const int threads : {2, 4}) {
    const MeshHierarchy many = build_hierarchy(mesh, topology, threads);
    REQUIRE(many.size() == one.size());
    for (size_t l = 0; l < one.size(); ++l) {
      CHECK(many[l].ring == one[l].ring);
      CHECK(many[l].finer == one[l].finer);
      CHECK(many[l].positions == one[l].positions);
    }
  }
}

TEST_CASE("mesh_hierarchy: levels shrink geometrically, also around a hub of 100,000") {
  for (const TriangleMesh& mesh : {icosphere(5), uv_sphere(100000, 1)}) {
    const MeshHierarchy hierarchy = build_hierarchy(mesh, Topology(mesh));
    CHECK(hierarchy.size() < 60);
  }
}

TEST_CASE("mesh_hierarchy: where edges have no length, valences still decide") {
  TriangleMesh mesh = icosphere(4);
  mesh.positions.setZero();
  for (const HierarchyLevel& level : build_hierarchy(mesh, Topology(mesh))) {
    for (Vertex v = 0; v < level.vertex_count(); ++v) CHECK(level.valence(v) <= 12);
  }
}
