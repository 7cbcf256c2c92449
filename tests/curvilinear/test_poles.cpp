#include <algorithm>
#include <catch2/catch.hpp>
#include <queue>

#include "middle_poles.h"
#include "sphparam/curvilinear/poles.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Distances along edges from `source`, by Bellman and Ford: slow and simple.
std::vector<double> distances(const TriangleMesh& mesh, const Topology& topology, Vertex source) {
  std::vector<double> distance(static_cast<size_t>(topology.vertex_count()), 1e300);
  distance[static_cast<size_t>(source)] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
      const Vertex a = topology.origin(h), b = topology.target(h);
      const double candidate =
          distance[static_cast<size_t>(a)] + (mesh.position(a) - mesh.position(b)).norm();
      if (candidate >= distance[static_cast<size_t>(b)]) continue;
      distance[static_cast<size_t>(b)] = candidate;
      changed = true;
    }
  }
  return distance;
}

/// Is there an edge between two vertices of v's link that are not neighbours there? All pairs.
bool has_chord(const Topology& topology, Vertex v) {
  std::vector<Vertex> link;
  topology.for_each_outgoing(v, [&](Halfedge h) { link.push_back(topology.target(h)); });
  for (size_t i = 0; i < link.size(); ++i) {
    for (size_t j = i + 2; j < link.size(); ++j) {
      if (i == 0 && j == link.size() - 1) continue;
      if (topology.find_halfedge(link[i], link[j]) >= 0) return true;
    }
  }
  return false;
}

int edges_between(const Topology& topology, Vertex from, Vertex to) {
  std::vector<int> depth(static_cast<size_t>(topology.vertex_count()), -1);
  std::queue<Vertex> queue({from});
  depth[static_cast<size_t>(from)] = 0;
  while (!queue.empty()) {
    const Vertex v = queue.front();
    queue.pop();
    topology.for_each_outgoing(v, [&](Halfedge h) {
      const Vertex u = topology.target(h);
      if (depth[static_cast<size_t>(u)] >= 0) return;
      depth[static_cast<size_t>(u)] = depth[static_cast<size_t>(v)] + 1;
      queue.push(u);
    });
  }
  return depth[static_cast<size_t>(to)];
}

/// Two vertices joined to every vertex of a ring: no two vertices are three edges apart.
TriangleMesh bipyramid(int around) { return uv_sphere(around, 1); }

/// A new vertex in face f, joined to its corners: f becomes a separating triangle.
TriangleMesh with_vertex_in_face(const TriangleMesh& mesh, Face f) {
  TriangleMesh result = mesh;
  const int v = static_cast<int>(mesh.vertex_count());
  const Eigen::RowVector3i t = mesh.triangles.row(f);
  result.positions.conservativeResize(v + 1, 3);
  result.positions.row(v) = (mesh.position(t[0]) + mesh.position(t[1]) + mesh.position(t[2])) / 3;
  result.triangles.conservativeResize(mesh.face_count() + 2, 3);
  result.triangles.row(f) << t[0], t[1], v;
  result.triangles.row(mesh.face_count()) << t[1], t[2], v;
  result.triangles.row(mesh.face_count() + 1) << t[2], t[0], v;
  return result;
}

}  // namespace

TEST_CASE("poles: the farthest pair are the ends of a tube") {
  const TriangleMesh mesh = tube(40, 6);
  const Topology topology(mesh);
  Poles poles = farthest_poles(mesh, topology);
  if (poles.north > poles.south) std::swap(poles.north, poles.south);
  CHECK(poles.north == 0);
  CHECK(poles.south == mesh.vertex_count() - 1);
}

TEST_CASE("poles: no vertex is farther from the south pole than the north pole") {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const TriangleMesh mesh = random_sphere_mesh(300, seed);
    const Topology topology(mesh);
    const Poles poles = farthest_poles(mesh, topology);
    const std::vector<double> distance = distances(mesh, topology, poles.south);
    CHECK(*std::max_element(distance.begin(), distance.end()) ==
          distance[static_cast<size_t>(poles.north)]);
  }
}

TEST_CASE("poles: a chord in a link is a planted separating triangle") {
  const TriangleMesh plain = icosphere(2);
  const Face f = 100;
  const TriangleMesh planted = with_vertex_in_face(plain, f);
  const Topology before(plain), after(planted);
  for (Vertex v = 0; v < before.vertex_count(); ++v) {
    CHECK(link_is_chord_free(before, v));
    const bool corner = (plain.triangles.row(f).array() == v).any();
    CHECK(link_is_chord_free(after, v) == !corner);
  }
}

TEST_CASE("poles: chords are found exactly where trying all pairs finds them") {
  const Topology topology(random_sphere_mesh(300, 4));
  int chords = 0;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    CHECK(link_is_chord_free(topology, v) == !has_chord(topology, v));
    chords += has_chord(topology, v);
  }
  CHECK(chords > 0);
  CHECK(chords < topology.vertex_count());
}

TEST_CASE("poles: usable poles have chord-free links and are three edges apart") {
  const Topology topology(random_sphere_mesh(120, 5));
  int usable = 0;
  for (Vertex a = 0; a < topology.vertex_count(); a += 3) {
    for (Vertex b = 0; b < topology.vertex_count(); b += 2) {
      const bool expected =
          !has_chord(topology, a) && !has_chord(topology, b) && edges_between(topology, a, b) >= 3;
      CHECK(poles_are_usable(topology, {a, b}) == expected);
      usable += expected;
    }
  }
  CHECK(usable > 0);
}

TEST_CASE("poles: a usable pair stays, another one is moved to a usable one nearby") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const Poles wanted = farthest_poles(mesh, topology);
  REQUIRE(poles_are_usable(topology, wanted));
  const auto same = nearest_usable_poles(topology, wanted);
  REQUIRE(same);
  CHECK(same->north == wanted.north);
  CHECK(same->south == wanted.south);

  // A pole at the corner of a planted separating triangle, and a pair of neighbours.
  const TriangleMesh planted = with_vertex_in_face(mesh, 0);
  const Topology with_chord(planted);
  const Vertex corner = mesh.triangles(0, 0);
  for (const Poles bad : {Poles{corner, wanted.south}, Poles{5, 5},
                          Poles{topology.origin(900), topology.target(900)}}) {
    CHECK_FALSE(poles_are_usable(with_chord, bad));
    const auto moved = nearest_usable_poles(with_chord, bad);
    REQUIRE(moved);
    CHECK(poles_are_usable(with_chord, *moved));
    CHECK(edges_between(with_chord, moved->north, bad.north) <= 3);
    CHECK(edges_between(with_chord, moved->south, bad.south) <= 3);
  }
}

TEST_CASE("poles: nothing is chosen where no pair is usable") {
  for (const TriangleMesh& mesh : {tetrahedron(), octahedron(), bipyramid(9), bipyramid(3000)}) {
    CHECK_FALSE(choose_poles(mesh, Topology(mesh)));
  }
}

TEST_CASE("poles: of a small mesh every pair is tried") {
  int usable_meshes = 0, unusable_meshes = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const TriangleMesh mesh = random_sphere_mesh(12, seed);
    const Topology topology(mesh);
    bool any = false;
    for (Vertex a = 0; a < 12; ++a) {
      for (Vertex b = 0; b < 12; ++b) any = any || poles_are_usable(topology, {a, b});
    }
    const auto chosen = choose_poles(mesh, topology);
    CHECK(chosen.has_value() == any);
    if (chosen) CHECK(poles_are_usable(topology, *chosen));
    (any ? usable_meshes : unusable_meshes)++;
  }
  CHECK(usable_meshes > 0);
  CHECK(unusable_meshes > 0);
}

TEST_CASE("poles along a direction: the farthest vertices, on flat tops the middle one") {
  TriangleMesh ball = icosphere(3);
  ball.positions *= 1e200;  // squares are beyond doubles
  const Topology topology(ball);
  for (const Vector3& up : {Vector3(0, 0, 1), Vector3(-1, 0, 0), Vector3(0.3, -2, 0.7)}) {
    const Poles poles = poles_along(ball, topology, up);
    for (Vertex v = 0; v < ball.vertex_count(); ++v) {
      CHECK(ball.position(v).dot(up) <= ball.position(poles.north).dot(up) * (1 + 3e-4));
      CHECK(ball.position(v).dot(up) >= ball.position(poles.south).dot(up) * (1 + 3e-4));
    }
    CHECK(vertex_along(ball, up, {poles.north}) != poles.north);
  }
  TriangleMesh can = icosphere(3);  // cut off flat above and below
  can.positions.col(2) = can.positions.col(2).cwiseMax(-0.8).cwiseMin(0.8);
  const Poles poles = poles_along(can, Topology(can), Vector3::UnitZ());
  CHECK(can.position(poles.north).head<2>().norm() < 0.01);
  CHECK(can.position(poles.north).z() == 0.8);
  CHECK(can.position(poles.south).head<2>().norm() < 0.01);
  CHECK(can.position(poles.south).z() == -0.8);
}

TEST_CASE("poles along a direction: never one vertex, and no edge where the mesh has room") {
  TriangleMesh flat = icosphere(2);
  flat.positions.col(2).setZero();
  const Topology topology(flat);
  const Poles poles = poles_along(flat, topology, Vector3::UnitZ());
  CHECK(poles.north != poles.south);
  CHECK(topology.find_halfedge(poles.north, poles.south) < 0);
  const TriangleMesh solid = icosphere(0);
  const Poles few = poles_along(solid, Topology(solid), Vector3(1, 2, 3));
  CHECK(few.north != few.south);
}

TEST_CASE("middle poles: of a body that leans, the middle of its own flat top and bottom") {
  TriangleMesh can = icosphere(3);  // cut off flat above and below
  can.positions.col(2) = can.positions.col(2).cwiseMax(-0.8).cwiseMin(0.8);
  const Topology topology(can);
  const Poles upright = poles_along(can, topology, Vector3::UnitZ());
  const auto middle = [&](const TriangleMesh& mesh, Poles poles) {
    return middle_poles(mesh, topology, Vector3::UnitZ(), {}, poles);
  };
  const Poles same = middle(can, upright);
  CHECK(same.north == upright.north);
  CHECK(same.south == upright.south);
  TriangleMesh leaning = can;
  leaning.positions.col(0) += can.positions.col(2);
  leaning.positions *= 1e200;
  const Poles beside = poles_along(leaning, topology, Vector3::UnitZ());
  CHECK(beside.north != upright.north);
  CHECK(beside.south != upright.south);
  const Poles found = middle(leaning, beside);
  CHECK(found.north == upright.north);
  CHECK(found.south == upright.south);
  // No face is as high as the tips of a ball but for some that have next to no area there.
  const TriangleMesh ball = icosphere(3);
  const Poles tips = poles_along(ball, topology, Vector3::UnitZ());
  CHECK(middle(ball, tips).north == tips.north);
}

TEST_CASE("middle poles: on the rim of a hole that is kept, the middle of what closes it") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const Poles tips = poles_along(mesh, topology, Vector3::UnitZ());
  FillerMarks fillers(static_cast<size_t>(mesh.face_count()), 0);
  topology.for_each_outgoing(
      tips.north, [&](Halfedge h) { fillers[static_cast<size_t>(Topology::face(h))] = 1; });
  const Vertex rim = topology.target(topology.outgoing(tips.north));
  const auto middle = [&](Poles poles) {
    return middle_poles(mesh, topology, Vector3::UnitZ(), fillers, poles);
  };
  CHECK(middle({rim, tips.south}).north == tips.north);
  CHECK(middle({rim, tips.south}).south == tips.south);
  CHECK(middle({tips.south, rim}).south == tips.north);
  CHECK_FALSE(poles_share_filler(topology, fillers, {rim, tips.south}));
  CHECK_FALSE(poles_share_filler(topology, {}, {rim, rim}));
  const Vertex across = topology.apex(topology.outgoing(tips.north));
  CHECK(poles_share_filler(topology, fillers, {rim, across}));
  CHECK(middle({rim, across}).north == rim);
  CHECK(middle({rim, across}).south == across);
}
