#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesh/handles/loop_basis.h"
#include "mesh/handles/loop_side.h"
#include "mesh/handles/short_loops.h"
#include "mesh/handles/surface_cells.h"
#include "mesh/repair/repair_state.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/mesh/topology.h"
#include "support/joined.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

RepairOptions only_handles(double longest = 10, HandleChoice choice = HandleChoice::Shortest) {
  RepairOptions options = RepairOptions::none();
  options.handles = true;
  options.longest_handle = longest;
  options.handle_choice = choice;
  return options;
}

std::uint64_t label_along(const Topology& topology, const LoopBasis& basis,
                          const std::vector<Vertex>& loop) {
  std::uint64_t label = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    label ^= basis.labels[static_cast<size_t>(
        topology.find_halfedge(loop[i], loop[(i + 1) % loop.size()]))];
  }
  return label;
}

/// Pieces of the surface without the edges of these loops.
long pieces_without(const Topology& topology, const std::vector<std::vector<Vertex>>& loops) {
  std::set<Halfedge> cut;
  for (const std::vector<Vertex>& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const Halfedge h = topology.find_halfedge(loop[i], loop[(i + 1) % loop.size()]);
      REQUIRE(h >= 0);
      cut.insert({h, topology.twin(h)});
    }
  }
  std::vector<char> seen(static_cast<size_t>(topology.face_count()), 0);
  long pieces = 0;
  for (Face first = 0; first < topology.face_count(); ++first) {
    if (seen[static_cast<size_t>(first)]) continue;
    ++pieces;
    std::vector<Face> waiting = {first};
    seen[static_cast<size_t>(first)] = 1;
    while (!waiting.empty()) {
      const Face f = waiting.back();
      waiting.pop_back();
      for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
        const Face other = Topology::face(topology.twin(h));
        if (cut.contains(h) || seen[static_cast<size_t>(other)]) continue;
        seen[static_cast<size_t>(other)] = 1;
        waiting.push_back(other);
      }
    }
  }
  return pieces;
}

std::vector<Vector3> places_of(const TriangleMesh& mesh) {
  std::vector<Vector3> places;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) places.push_back(mesh.position(v));
  return places;
}

bool is_simple(const std::vector<Vertex>& loop) {
  return loop.size() >= 3 && std::set<Vertex>(loop.begin(), loop.end()).size() == loop.size();
}

/// What the removal of handles promises, whatever the mesh.
void check_cut(const TriangleMesh& mesh, const RepairedMesh& cut) {
  const MeshInspection before = inspect_mesh(mesh);
  // Each loop makes two caps: Euler's number goes up by two.
  CHECK(cut.inspection.euler_characteristic ==
        before.euler_characteristic + 2 * std::ssize(cut.handles));
  CHECK(cut.inspection.components == before.components);
  CHECK(Topology::try_build(cut.mesh.triangles, static_cast<int>(cut.mesh.vertex_count())));
  // All that was there is there, in its place and order.
  CHECK(cut.mesh.positions.topRows(mesh.vertex_count()) == mesh.positions);
  const Triangles& triangles = cut.mesh.triangles;
  double area = before.area;
  for (const HandleLoop& loop : cut.handles) area += loop.area_added;
  CHECK(cut.inspection.area == Approx(area));
  for (Face f = 0; f < mesh.face_count(); ++f) {
    CHECK(cut.face_origin[static_cast<size_t>(f)] == f);
    for (int k = 0; k < 3; ++k) {
      const Vertex origin = cut.vertex_origin[static_cast<size_t>(triangles(f, k))];
      if (origin != mesh.triangles(f, k)) FAIL("face " << f << " names another vertex");
    }
  }
  for (Face f = static_cast<Face>(mesh.face_count()); f < triangles.rows(); ++f) {
    if (cut.face_origin[static_cast<size_t>(f)] != -1) FAIL("a cap has a source");
  }
  for (Vertex v = 0; v < cut.mesh.vertex_count(); ++v) {
    const Vertex origin = cut.vertex_origin[static_cast<size_t>(v)];
    if (origin >= 0 && cut.mesh.position(v) != mesh.position(origin)) FAIL("vertex " << v);
  }
  for (const HandleLoop& loop : cut.handles) {
    CHECK(loop.vertices.size() == loop.points.size());
    CHECK(loop.vertices.size() >= 3);
  }
}

}  // namespace

TEST_CASE("handles: loops of the basis are simple, two a handle, and separate nothing together") {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const TriangleMesh mesh = relabelled(noisy_ball(16, 0.2, seed), seed);
    const Topology topology(mesh);
    const LoopBasis basis = loop_basis(topology);
    const long genus = inspect_mesh(mesh).genus;
    INFO("seed " << seed << ", genus " << genus);
    REQUIRE(std::ssize(basis.loops) == 2 * genus);
    for (const std::vector<Vertex>& loop : basis.loops) {
      CHECK(is_simple(loop));
      CHECK(label_along(topology, basis, loop) != 0);
      CHECK(pieces_without(topology, {loop}) == 1);
    }
    // About each face labels cancel.
    for (Halfedge h = 0; h < topology.halfedge_count() && genus > 0; h += 3) {
      const auto at = [&](Halfedge side) { return basis.labels[static_cast<size_t>(side)]; };
      if ((at(h) ^ at(h + 1) ^ at(h + 2)) != 0) FAIL("face " << h / 3);
    }
  }
  CHECK(loop_basis(Topology(icosphere(2))).loops.empty());
}

TEST_CASE("handles: labels vanish on what separates, and only there") {
  const TriangleMesh mesh = bumped_torus(12, 30, 0.4, 0.1, 7);
  const Topology topology(mesh);
  const LoopBasis basis = loop_basis(topology);
  std::vector<Vertex> about_tube, about_hole;
  for (int i = 0; i < 12; ++i) about_tube.push_back(5 * 12 + i);
  for (int i = 0; i < 30; ++i) about_hole.push_back(12 * i + 3);
  const std::vector<Vertex> about_vertex = {6 * 12 + 5, 7 * 12 + 6, 7 * 12 + 7,
                                            6 * 12 + 7, 5 * 12 + 6, 5 * 12 + 5};
  CHECK(label_along(topology, basis, about_tube) != 0);
  CHECK(label_along(topology, basis, about_hole) != 0);
  CHECK(label_along(topology, basis, about_tube) != label_along(topology, basis, about_hole));
  CHECK(pieces_without(topology, {about_vertex}) == 2);
  CHECK(label_along(topology, basis, about_vertex) == 0);
}

TEST_CASE("handles: the shortest loop through a vertex is found, and no longer ones when told") {
  const TriangleMesh mesh = bumped_torus(12, 40, 0.3, 0, 1);
  const Topology topology(mesh);
  const LoopBasis basis = loop_basis(topology);
  const std::vector<Vector3> places = places_of(mesh);
  const ShortLoops search(topology, basis, places);
  // A regular polygon of 12 sides about the tube.
  const double about_tube = 12 * (places[1] - places[0]).norm();
  const std::vector<EdgeLoop> loops = search.through(100, 1.1 * about_tube);
  REQUIRE_FALSE(loops.empty());
  const auto shortest = std::min_element(loops.begin(), loops.end(),
                                         [](auto& x, auto& y) { return x.length < y.length; });
  CHECK(shortest->length == Approx(about_tube));
  CHECK(shortest->vertices.size() == 12);
  CHECK(is_simple(shortest->vertices));
  CHECK(shortest->label == label_along(topology, basis, shortest->vertices));
  CHECK(search.through(100, 0.99 * about_tube).empty());
}

TEST_CASE("handles: a loop about the tube cuts, one about the hole fills") {
  const TriangleMesh mesh = bumped_torus(12, 40, 0.3, 0.05, 2);
  const Topology topology(mesh);
  const std::vector<Vector3> places = places_of(mesh);
  std::vector<Vertex> about_tube, about_hole;
  for (int i = 0; i < 12; ++i) about_tube.push_back(5 * 12 + i);
  for (int i = 0; i < 40; ++i) about_hole.push_back(12 * i + 6);  // the inner side
  for (const bool reversed : {false, true}) {
    CHECK_FALSE(spans_outside(topology, places, about_tube));
    CHECK(spans_outside(topology, places, about_hole));
    if (reversed) break;
    std::reverse(about_tube.begin(), about_tube.end());
    std::reverse(about_hole.begin(), about_hole.end());
  }
}

TEST_CASE("handles: surfaces of noisy volumes, bumped tori and grids of tubes end without any") {
  std::vector<std::pair<std::string, TriangleMesh>> surfaces;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const std::string name = "seed " + std::to_string(seed);
    const int across = 12 + static_cast<int>(seed % 4) * 4;
    surfaces.emplace_back("ball, " + name, noisy_ball(across, 0.12 + 0.002 * seed, seed));
    surfaces.emplace_back(
        "torus, " + name,
        relabelled(bumped_torus(5 + static_cast<int>(seed % 9), 24, 0.1 + 0.01 * seed, 0.3, seed),
                   seed));
  }
  for (const int n : {2, 3, 6, 8}) {
    surfaces.emplace_back("tubes, " + std::to_string(n), tube_grid(n, n, 6, 0.25));
  }
  long handles = 0;
  for (const auto& [name, mesh] : surfaces) {
    INFO(name);
    const long genus = inspect_mesh(mesh).genus;
    const RepairedMesh cut = repair_mesh(mesh, only_handles());
    check_cut(mesh, cut);
    CHECK(std::ssize(cut.handles) == genus);
    CHECK(cut.inspection.is_sphere());
    CHECK(cut.shortest_handle_left == 0);
    handles += genus;
    // Loops are told by the ids of the input: simple ones run along its edges, and those of them
    // that were cut first separate nothing there.
    if (cut.handles.empty()) continue;
    const std::vector<Vertex>& first = cut.handles.front().vertices;
    CHECK(is_simple(first));
    CHECK(pieces_without(Topology(mesh), {first}) == 1);
  }
  CHECK(handles > 200);
}

TEST_CASE("handles: of loops that only together separate the surface one stays whole") {
  // Two tubes and n from one to the other: loops about all of these n would leave two pieces.
  for (const int n : {3, 4, 5}) {
    INFO(n << " tubes");
    const TriangleMesh mesh = tube_grid(2, n, 6, 0.25);
    const RepairedMesh cut = repair_mesh(mesh, only_handles());
    check_cut(mesh, cut);
    CHECK(std::ssize(cut.handles) == n - 1);
    CHECK(cut.inspection.is_sphere());
  }
}

TEST_CASE("handles: all in one place, whatever is done, they go") {
  for (TriangleMesh mesh : {bumped_torus(7, 9, 0.3, 0, 1), noisy_ball(12, 0.25, 5)}) {
    mesh.positions.setZero();
    const RepairedMesh cut = repair_mesh(mesh, only_handles());
    CHECK(cut.inspection.genus == 0);
  }
}

TEST_CASE("handles: the wanted one of two loops is cut along") {
  const TriangleMesh mesh = bumped_torus(16, 40, 0.3, 0.05, 3);
  const RepairedMesh through = repair_mesh(mesh, only_handles(10, HandleChoice::Cut));
  const RepairedMesh closed = repair_mesh(mesh, only_handles(10, HandleChoice::Fill));
  for (const RepairedMesh* cut : {&through, &closed}) {
    check_cut(mesh, *cut);
    CHECK(cut->inspection.is_sphere());
    REQUIRE(cut->handles.size() == 1);
    CHECK(cut->handles[0].filled == (cut == &closed));
    REQUIRE(cut->actions.size() == 1);
    CHECK(cut->actions[0].kind ==
          (cut == &closed ? RepairKind::HandleFilled : RepairKind::HandleCut));
  }
  CHECK(through.handles[0].length == Approx(2 * 3.14159 * 0.3).epsilon(0.1));
  CHECK(closed.handles[0].length == Approx(2 * 3.14159 * 0.7).epsilon(0.1));
  CHECK(through.handles[0].area_added == Approx(2 * 3.14159 * 0.09).epsilon(0.2));
  // Of loops that are all found at once, the one whose caps have the least area.
  const TriangleMesh coarse = bumped_torus(8, 10, 0.3, 0.05, 3);
  const RepairedMesh by_area = repair_mesh(coarse, only_handles(10, HandleChoice::Area));
  CHECK_FALSE(by_area.handles.at(0).filled);
  CHECK(by_area.handles[0].length < 2);
  // Inside out it is the same surface, the other side.
  TriangleMesh inside_out = mesh;
  inside_out.triangles.col(1).swap(inside_out.triangles.col(2));
  CHECK_FALSE(repair_mesh(inside_out, only_handles(10, HandleChoice::Cut)).handles.at(0).filled);
}

TEST_CASE("handles: those longer than the limit stay, and the length that it takes is told") {
  const TriangleMesh mesh = bumped_torus(16, 40, 0.3, 0.05, 3);
  const RepairedMesh refused = repair_mesh(mesh);
  CHECK(refused.inspection.genus == 1);
  CHECK(refused.actions.empty());
  const double needed = refused.shortest_handle_left;
  CHECK(needed > RepairOptions{}.longest_handle);
  CHECK(repair_mesh(mesh, only_handles(0.999 * needed)).inspection.genus == 1);
  const RepairedMesh cut = repair_mesh(mesh, only_handles(1.001 * needed));
  REQUIRE(cut.inspection.is_sphere());
  CHECK(cut.handles[0].share == Approx(needed));
  const double diagonal =
      (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  CHECK(cut.handles[0].length == Approx(needed * diagonal));
  RepairOptions by_length = only_handles(0);
  by_length.longest_handle_length = 1.001 * cut.handles[0].length;
  CHECK(repair_mesh(mesh, by_length).inspection.is_sphere());
  by_length.longest_handle_length = 0.999 * cut.handles[0].length;
  CHECK(repair_mesh(mesh, by_length).inspection.genus == 1);
}

TEST_CASE("handles: how long one is is a matter of its own part, whatever else is in the file") {
  const TriangleMesh torus = bumped_torus(16, 40, 0.3, 0.05, 3);
  const double needed = repair_mesh(torus).shortest_handle_left;
  REQUIRE(needed > RepairOptions{}.longest_handle);
  for (const TriangleMesh& other : {torus, icosphere(1), noisy_ball(10, 0.1, 1)}) {
    const TriangleMesh both = joined(torus, other, {100, 0, 0});
    RepairOptions options = only_handles(RepairOptions{}.longest_handle);
    const RepairedMesh kept = repair_mesh(both, options);
    CHECK(kept.shortest_handle_left == Approx(needed));
    for (const HandleLoop& loop : kept.handles) CHECK(loop.centre.x() > 50);
    options.longest_handle = 1.001 * needed;
    const RepairedMesh cut = repair_mesh(both, options);
    check_cut(both, cut);
    const auto is_of_torus = [](const HandleLoop& loop) { return loop.centre.x() < 50; };
    CHECK(std::ranges::count_if(cut.handles, is_of_torus) == 1);
  }
}

TEST_CASE("handles: where some are longer than the limit, others go all the same, and alike") {
  const TriangleMesh mesh = noisy_ball(24, 0.15, 1);
  const RepairedMesh all = repair_mesh(mesh, only_handles());
  double longest = 0;
  for (const HandleLoop& loop : all.handles) longest = std::max(longest, loop.share);
  const RepairedMesh same = repair_mesh(mesh, only_handles(longest * (1 + 1e-9)));
  CHECK(same.mesh.triangles == all.mesh.triangles);
  const RepairedMesh some = repair_mesh(mesh, only_handles(longest * 0.9));
  CHECK(some.inspection.genus > 0);
  CHECK(some.inspection.genus < std::ssize(all.handles));
  CHECK(some.shortest_handle_left > 0.9 * longest);
  for (const HandleLoop& loop : some.handles) CHECK(loop.share <= 0.9 * longest);
  check_cut(mesh, some);
}

TEST_CASE("handles: after holes are filled and sheets cut apart, in one go, and then for good") {
  TriangleMesh mesh = noisy_ball(20, 0.17, 4);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  const RepairedMesh repaired = repair_mesh(mesh);
  CHECK(repaired.inspection.is_sphere());
  const RepairedMesh again = repair_mesh(repaired.mesh);
  CHECK(again.handles.empty());
  CHECK(again.mesh.triangles == repaired.mesh.triangles);
  RepairOptions without;
  without.handles = false;
  CHECK(repair_mesh(mesh, without).inspection.genus > 0);
}

TEST_CASE("handles: faces that all run across the whole box are found by cells, in little memory") {
  // Strips from corner to corner beside each other: each is in every cell of its box.
  constexpr int strips = 200000;
  const Vector3 up(0.7, -0.7, 0);
  TriangleMesh mesh{Points(3 * strips, 3), Triangles(strips, 3)};
  for (int i = 0; i < strips; ++i) {
    const Vector3 beside = 1e-3 * i / strips * up;
    mesh.positions.row(3 * i) = Vector3(-1, -1, -1) + beside;
    mesh.positions.row(3 * i + 1) = Vector3(1, 1, 1) + beside;
    mesh.positions.row(3 * i + 2) = Vector3(1, 1, 1) + beside + 1e-4 / strips * up;
    mesh.triangles.row(i) << 3 * i, 3 * i + 1, 3 * i + 2;
  }
  const RepairState state(mesh);
  const SurfaceCells cells(state);
  // Across all of them, and beside them.
  const auto across = [&](const Vector3& middle) {
    const Vector3 aside(0.1, 0.1, -0.2);
    return cells.crossings(
        {middle - 0.1 * up - aside, middle + 0.1 * up - aside, Vector3(middle + 2 * aside)});
  };
  CHECK(across({0.1, 0.1, 0.1}) == strips);
  CHECK(across({0.1, 0.1, -0.5}) == 0);
}

TEST_CASE("handles: a crumpled one without a loop of the kind asked for is cut along the other") {
  constexpr unsigned seed = 5494;
  const TriangleMesh torus =
      relabelled(bumped_torus(3 + seed % 17, 4 + seed % 41, 0.05 + 0.008 * (seed % 100),
                              0.01 * (seed % 60), seed),
                 seed);
  RepairOptions options = RepairOptions::none();
  options.handles = true;
  options.longest_handle = 10;
  options.handle_choice = HandleChoice::Fill;
  const RepairedMesh cut = repair_mesh(torus, options);
  CHECK(cut.inspection.is_sphere());
  REQUIRE(cut.handles.size() == 1);
  CHECK_FALSE(cut.handles.front().filled);
}
