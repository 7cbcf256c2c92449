#include <array>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "mesh/index_range.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

TriangleMesh some_mesh(int which) {
  switch (which) {
    case 0:
      return tetrahedron();
    case 1:
      return icosphere(2);
    case 2:
      return uv_sphere(40, 3);
    default:
      return random_sphere_mesh(200, 7);
  }
}

}  // namespace

TEST_CASE("topology: twins pair up and run through the same edge the other way") {
  const TriangleMesh mesh = some_mesh(GENERATE(0, 1, 2, 3));
  const Topology topology(mesh);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    REQUIRE(topology.twin(h) != h);
    REQUIRE(topology.twin(topology.twin(h)) == h);
    REQUIRE(topology.origin(topology.twin(h)) == topology.target(h));
    REQUIRE(topology.target(topology.twin(h)) == topology.origin(h));
  }
}

TEST_CASE("topology: corners are the faces' own, and next goes around the face") {
  const TriangleMesh mesh = icosphere(1);
  const Topology topology(mesh);
  for (Face f = 0; f < topology.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Halfedge h = 3 * f + k;
      REQUIRE(topology.origin(h) == mesh.triangles(f, k));
      REQUIRE(topology.target(h) == mesh.triangles(f, (k + 1) % 3));
      REQUIRE(topology.apex(h) == mesh.triangles(f, (k + 2) % 3));
      REQUIRE(Topology::previous(Topology::next(h)) == h);
    }
  }
}

TEST_CASE("topology: a vertex's half-edges are visited once, counter-clockwise") {
  const TriangleMesh mesh = some_mesh(GENERATE(0, 1, 2, 3));
  const Topology topology(mesh);
  long visited = 0;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    topology.for_each_outgoing(v, [&](Halfedge h) {
      ++visited;
      REQUIRE(topology.origin(h) == v);
      REQUIRE(topology.rotate_cw(topology.rotate_ccw(h)) == h);
      // Counter-clockwise: the face between h and its successor is h's own.
      REQUIRE(topology.target(topology.rotate_ccw(h)) == topology.apex(h));
    });
  }
  CHECK(visited == topology.halfedge_count());
}

TEST_CASE("topology: find_halfedge finds edges and only edges") {
  const TriangleMesh mesh = octahedron();
  const Topology topology(mesh);
  CHECK(topology.find_halfedge(0, 1) == -1);  // opposite corners
  const Halfedge h = topology.find_halfedge(0, 2);
  REQUIRE(h >= 0);
  CHECK(topology.target(h) == 2);
}

TEST_CASE("topology: open, misoriented and non-manifold meshes are refused with their reasons") {
  TriangleMesh open = octahedron();
  open.triangles.conservativeResize(7, 3);
  CHECK_THROWS_AS(Topology(open), MeshError);

  TriangleMesh turned = octahedron();
  std::swap(turned.triangles(0, 0), turned.triangles(0, 1));
  CHECK_THROWS_AS(Topology(turned), MeshError);

  TriangleMesh unused = octahedron();
  unused.positions.conservativeResize(7, 3);
  unused.positions.row(6).setZero();
  try {
    const Topology topology(unused);
    FAIL("an unused vertex was accepted");
  } catch (const MeshError& error) {
    REQUIRE(error.defects().size() == 1);
    CHECK(error.defects()[0].kind == DefectKind::UnusedVertex);
    CHECK(error.defects()[0].elements == std::vector<int>{6});
  }
}

TEST_CASE("topology: more faces than have numbers are refused, and what to do is said") {
  CHECK_NOTHROW(require_numbered(715827882, 2147483647));
  CHECK_THROWS_AS(require_numbered(4, 2147483648), std::length_error);
  CHECK_THROWS_WITH(require_numbered(715827883, 4),
                    "a mesh of 715827883 faces and 4 vertices: of faces 715827882 have numbers, of "
                    "vertices 2147483647; make it coarser, or take it in parts");
}

TEST_CASE("topology: a fan of 100,000 faces is built at once") {
  const TriangleMesh mesh = uv_sphere(100000, 1);
  const Topology topology(mesh);
  CHECK(topology.valence(0) == 100000);
}

TEST_CASE("topology: 100,000 copies of a face are refused at once") {
  constexpr int copies = 100000;
  Triangles triangles(copies + 3, 3);
  for (int f = 0; f < copies; ++f) triangles.row(f) << 0, 1, 2;
  // Every edge of the copies has exactly one opposite: only the copies themselves are wrong.
  triangles.bottomRows<3>() << 1, 0, 3, 2, 1, 4, 0, 2, 5;
  CHECK_FALSE(Topology::try_build(triangles, 6));
}

TEST_CASE("topology: an edge with four faces is refused, also between two hubs") {
  // Two bodies that share the edge 0–1: the fans 0, p, p + 1 and 1, p + 1, p of a closed band each.
  // In the one order of the last faces fans of each body could be told, in the other one fan of
  // all.
  constexpr int band = 40, one = 2, other = 2 + band + 1;
  for (const std::array<int, 2>& last : {std::array{one, other}, {other, one}}) {
    std::vector<std::array<int, 3>> faces;
    for (const int p : {one, other}) {
      for (int i = 0; i < band; ++i) {
        faces.push_back({0, p + i, p + i + 1});
        faces.push_back({1, p + i + 1, p + i});
      }
    }
    for (const int p : {one, other}) faces.push_back({0, 1, p});
    for (const int p : last) faces.push_back({1, 0, p + band});
    Triangles triangles(static_cast<Eigen::Index>(faces.size()), 3);
    for (size_t f = 0; f < faces.size(); ++f) {
      triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    }
    CHECK_FALSE(Topology::try_build(triangles, 2 + 2 * (band + 1)));
  }
}
