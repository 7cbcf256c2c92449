#include <catch2/catch.hpp>
#include <limits>
#include <random>

#include "sphparam/mesh/self_crossings.h"
#include "support/joined.h"
#include "support/test_meshes.h"

namespace sphparam::tests {
namespace {

TriangleMesh mesh_of(const std::vector<Vector3>& places,
                     const std::vector<std::array<int, 3>>& of) {
  TriangleMesh mesh{Points(std::ssize(places), 3), Triangles(std::ssize(of), 3)};
  for (int v = 0; v < std::ssize(places); ++v) mesh.positions.row(v) = places[size_t(v)];
  for (int f = 0; f < std::ssize(of); ++f)
    for (int k = 0; k < 3; ++k) mesh.triangles(f, k) = of[size_t(f)][size_t(k)];
  return mesh;
}

/// The corner of a block at the origin, cut off where its edges are so long.
TriangleMesh block_corner(double length) {
  return mesh_of({{0, 0, 0}, {length, 0, 0}, {0, length, 0}, {0, 0, length}},
                 {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
}

/// The second one's corner comes through the slanted face of the first.
TriangleMesh two_blocks() { return joined(block_corner(4), block_corner(4), {1, 1, 1}); }

/// An L, extruded: walls of two triangles each, floor and ceiling of six about a vertex at (x, y),
/// which is in sight of all corners at (0.5, 0.5).
TriangleMesh extruded_L(double x, double y) {
  constexpr int n = 6;
  const std::array<std::array<double, 2>, n> outline{
      {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  TriangleMesh mesh{Points(2 * n + 2, 3), Triangles(4 * n, 3)};
  for (int i = 0; i < n; ++i) {
    const auto& [u, v] = outline[static_cast<size_t>(i)];
    mesh.positions.row(i) << u, v, 0;
    mesh.positions.row(n + i) << u, v, 1;
    const int j = (i + 1) % n;
    mesh.triangles.row(4 * i) << i, j, n + j;
    mesh.triangles.row(4 * i + 1) << i, n + j, n + i;
    mesh.triangles.row(4 * i + 2) << j, i, 2 * n;
    mesh.triangles.row(4 * i + 3) << n + i, n + j, 2 * n + 1;
  }
  mesh.positions.row(2 * n) << x, y, 0;
  mesh.positions.row(2 * n + 1) << x, y, 1;
  return mesh;
}

/// Triangles that all run across the whole.
TriangleMesh sticks(int count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  TriangleMesh mesh{Points(3 * count, 3), Triangles(count, 3)};
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) mesh.positions(3 * i + k, j) = uniform(random);
      mesh.triangles(i, k) = 3 * i + k;
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("self-crossings: a ball, a fine one and a rough one, has none, and that is proved") {
  for (const TriangleMesh& mesh : {icosphere(5), tetrahedron(), tube(40, 9)}) {
    const SelfCrossings found = find_self_crossings(mesh);
    CHECK(found.none());
    CHECK(found.pairs == 0);
    CHECK(found.faces == 0);
    CHECK(found.marks.empty());
    CHECK(found.first == std::array<Face, 2>{-1, -1});
  }
}

TEST_CASE(
    "self-crossings: two tetrahedra pushed into each other cross in three pairs of four faces") {
  const SelfCrossings found = find_self_crossings(two_blocks());
  CHECK(found.pairs == 3);
  CHECK(found.faces == 4);
  CHECK(found.marks == FillerMarks{0, 0, 0, 1, 1, 1, 1, 0});
  CHECK(found.first == std::array<Face, 2>{3, 4});
  CHECK(found.all);
  CHECK_FALSE(found.none());
  CHECK(found.place == Vector3(2.5, 2.5, 1));  // of x, y, z ∈ [1, 4], and z is 1 on face 4
}

TEST_CASE("self-crossings: a strip that is folded over lies on itself, sides in common or not") {
  const std::vector<Vector3> places{{0, 0, 0}, {1, 0, 0}, {1, 1, 0},
                                    {0, 1, 0}, {0, 0, 0}, {0, 1, 0}};
  const auto strip = [&](double up) {
    TriangleMesh mesh = mesh_of(places, {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}});
    mesh.positions(4, 2) = mesh.positions(5, 2) = up;
    return find_self_crossings(mesh);
  };
  const SelfCrossings flat = strip(0);
  CHECK(flat.pairs == 4);
  CHECK(flat.faces == 4);
  CHECK(flat.first == std::array<Face, 2>{0, 2});
  CHECK(strip(0x1p-60).none());
}

TEST_CASE(
    "self-crossings: an L whose flat walls lie side by side has none until a vertex is beyond") {
  CHECK(find_self_crossings(extruded_L(0.5, 0.5)).none());
  // In each fan the two faces at the notch are turned over, each of them over two others.
  const SelfCrossings found = find_self_crossings(extruded_L(1.5, 1.5));
  CHECK(found.pairs == 2 * 4);
  CHECK(found.faces == 2 * 6);
}

TEST_CASE(
    "self-crossings: a sheet of two sides, whose corners are other vertices, lies on itself") {
  const TriangleMesh mesh = mesh_of(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {4, 3, 5}});
  CHECK(find_self_crossings(mesh).pairs == 1);
}

TEST_CASE("self-crossings: bodies that touch do not cross, but where a face lies over another") {
  const auto both = [](double length, const Vector3& place) {
    return find_self_crossings(joined(block_corner(4), block_corner(length), place));
  };
  CHECK(both(4, {4, 0, 0}).none());    // corner at corner
  CHECK(both(1, {1, 1, 2}).none());    // a corner on the slanted face
  CHECK(both(0.5, {1, 1, 1}).none());  // inside
  CHECK(both(1, {1, 1, 1}).pairs == 1);
}

TEST_CASE("self-crossings: of any size, in any order, by any number of threads") {
  const TriangleMesh balls = joined(icosphere(4), icosphere(4), {0.7, 0.5, 0.3});
  const SelfCrossings one = find_self_crossings(balls, {.threads = 1});
  CHECK(one.pairs > 100);
  for (const int threads : {2, 7}) {
    const SelfCrossings other = find_self_crossings(balls, {.threads = threads});
    CHECK(other.pairs == one.pairs);
    CHECK(other.marks == one.marks);
    CHECK(other.first == one.first);
    CHECK(other.place == one.place);
  }
  const TriangleMesh shuffled = relabelled(balls, 1);
  CHECK(find_self_crossings(shuffled).pairs == one.pairs);
  CHECK(find_self_crossings(shuffled).faces == one.faces);
  for (const double size : {0x1p-900, 0x1p900}) {
    TriangleMesh scaled = balls;
    scaled.positions *= size;
    CHECK(find_self_crossings(scaled).marks == one.marks);
    CHECK(find_self_crossings(scaled).place == size * one.place);
  }
}

TEST_CASE("self-crossings: all pairs of a soup agree with one by one") {
  const TriangleMesh soup = sticks(200);
  std::int64_t pairs = 0;
  for (Face f = 0; f < 200; ++f) {
    for (Face g = f + 1; g < 200; ++g) {
      TriangleMesh two{soup.positions, Triangles(2, 3)};
      two.triangles << soup.triangles.row(f), soup.triangles.row(g);
      pairs += find_self_crossings(two).pairs;
    }
  }
  CHECK(pairs > 1000);
  CHECK(find_self_crossings(soup).pairs == pairs);
}

TEST_CASE("self-crossings: faces that are no triangles in space are left out") {
  TriangleMesh mesh = two_blocks();
  mesh.triangles(4, 0) = 8;  // a vertex that is not there
  mesh.triangles(5, 1) = -1;
  CHECK(find_self_crossings(mesh).pairs == 1);
  mesh = two_blocks();
  mesh.positions(4, 0) = std::numeric_limits<double>::quiet_NaN();  // the corner that comes through
  CHECK(find_self_crossings(mesh).none());
  CHECK(find_self_crossings(TriangleMesh{}).none());
}

TEST_CASE("self-crossings: a soup is cut short where that is wanted, the same by any threads") {
  const TriangleMesh soup = sticks(3000);
  const SelfCrossings all = find_self_crossings(soup);
  CHECK(all.all);
  const SelfCrossings some = find_self_crossings(soup, {.most_looks = 10, .threads = 1});
  CHECK_FALSE(some.all);
  CHECK(some.pairs > 0);
  CHECK(some.pairs < all.pairs);
  CHECK(find_self_crossings(soup, {.most_looks = 10, .threads = 5}).pairs == some.pairs);
  CHECK(find_self_crossings(icosphere(5), {.most_looks = 100}).none());
  CHECK_THROWS_AS(find_self_crossings(soup, {.most_looks = -1}), std::invalid_argument);
}

}  // namespace sphparam::tests
