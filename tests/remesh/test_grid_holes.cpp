#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <ranges>
#include <vector>

#include "remesh/grid_holes.h"
#include "sphparam/remesh/sphere_grid.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

const TriangleMesh ball = icosphere(3);
const Topology topology(ball);
const Triangulation triangles = {.triangles = ball.triangles, .corner = {}, .polygon = {}};

double height_of(Face f) {
  return (ball.position(ball.triangles(f, 0)) + ball.position(ball.triangles(f, 1)) +
          ball.position(ball.triangles(f, 2)))
             .z() /
         3;
}

/// The hole of each face by its height; −1 is surface.
std::vector<int> by_height(const std::function<int(double)>& hole) {
  std::vector<int> holes;
  for (Face f = 0; f < topology.face_count(); ++f) holes.push_back(hole(height_of(f)));
  return holes;
}

FillerMarks marks(const std::vector<int>& holes) {
  FillerMarks result;
  for (const int hole : holes) result.push_back(hole >= 0);
  return result;
}

}  // namespace

TEST_CASE("grid holes: fillers that share an edge close one hole, others another") {
  const FillerMarks caps = marks(by_height([](double z) { return std::abs(z) > 0.8 ? 0 : -1; }));
  const std::vector<int> holes = holes_of(topology, caps);
  const int north = *std::ranges::max_element(
      holes, {}, [&](const int& hole) { return height_of(static_cast<Face>(&hole - &holes[0])); });
  CHECK((north == 0 || north == 1));
  for (Face f = 0; f < topology.face_count(); ++f) {
    const double z = height_of(f);
    CHECK(holes[static_cast<size_t>(f)] == (z > 0.8 ? north : z < -0.8 ? 1 - north : -1));
  }
}

TEST_CASE("grid holes: what is tidy stays as it is, and so do fillers without a surface") {
  const auto holes = by_height([](double z) { return z > 0.8 ? 0 : z < -0.8 ? 1 : -1; });
  CHECK(tidy_fillers(topology, triangles, holes) == marks(holes));
  const std::vector<int> all(holes.size(), 0);
  CHECK(tidy_fillers(topology, triangles, all) == marks(all));
}

TEST_CASE("grid holes: of a surface in pieces the largest stays") {
  const auto belt = by_height([](double z) { return z > 0.3 && z < 0.6 ? 0 : -1; });
  const auto wanted = by_height([](double z) { return z > 0.3 ? 0 : -1; });
  CHECK(tidy_fillers(topology, triangles, belt) == marks(wanted));
}

TEST_CASE("grid holes: of each hole the largest piece stays, however small another hole is") {
  const auto faces = std::views::iota(Face{0}, topology.face_count());
  for (const int side : {1, -1}) {
    const auto cap = by_height([&](double z) { return side * z > 0.8 ? 0 : -1; });
    const auto is_far = [&](Face f) { return side * height_of(f) < 0; };
    const Face first = *std::ranges::find_if(faces, is_far),
               last = *std::ranges::find_if(faces | std::views::reverse, is_far);
    for (const Face speck : {first, last}) {  // before and after the rest of its hole
      auto holes = cap;
      holes[static_cast<size_t>(speck)] = 0;
      CHECK(tidy_fillers(topology, triangles, holes) == marks(cap));
      holes[static_cast<size_t>(speck)] = 1;  // a hole of one triangle
      CHECK(tidy_fillers(topology, triangles, holes) == marks(holes));
    }
  }
}

TEST_CASE("grid holes: where fillers touch at a vertex all about it are fillers") {
  std::vector<int> holes(static_cast<size_t>(topology.face_count()), -1);
  const Vertex v = 100;
  std::vector<Face> about;
  topology.for_each_outgoing(v, [&](Halfedge h) { about.push_back(Topology::face(h)); });
  REQUIRE(about.size() == 6);
  holes[static_cast<size_t>(about[0])] = holes[static_cast<size_t>(about[3])] = 0;
  std::vector<int> wanted(holes.size(), -1);
  for (const Face f : about) wanted[static_cast<size_t>(f)] = 0;
  CHECK(tidy_fillers(topology, triangles, holes) == marks(wanted));
}

TEST_CASE("grid holes: where fillers touch at a vertex the quads about it are fillers whole") {
  const SphereGrid grid = make_grid(parse_grid("cube:4"));
  const Triangulation cut = triangulate(grid.directions, grid.faces);
  const Topology of_cut(cut.triangles, static_cast<int>(grid.directions.rows()));
  const auto has_four = [&](Vertex v) { return std::ranges::count(grid.faces.corners, v) == 4; };
  const Vertex v = *std::ranges::find_if(std::views::iota(Vertex{0}), has_four);
  std::vector<int> about;  // quads, in turn
  of_cut.for_each_outgoing(v, [&](Halfedge h) {
    const auto p = static_cast<int>(cut.polygon_of(Topology::face(h)));
    if (std::ranges::find(about, p) == about.end()) about.push_back(p);
  });
  REQUIRE(about.size() == 4);
  for (const size_t first : {0U, 1U}) {
    std::vector<int> holes, wanted;
    for (const int p : cut.polygon) {
      holes.push_back(p == about[first] || p == about[first + 2] ? 0 : -1);
      wanted.push_back(std::ranges::find(about, p) != about.end() ? 0 : -1);
    }
    CHECK(tidy_fillers(of_cut, cut, holes) == marks(wanted));
  }
}
