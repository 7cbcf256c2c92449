#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>

#include "sphparam/io/polygons.h"

using namespace sphparam;

namespace {

Polygons polygons_of(const std::vector<std::vector<int>>& faces) {
  Polygons polygons;
  for (const std::vector<int>& face : faces) {
    for (const int v : face) polygons.add_corner(v);
    REQUIRE(polygons.close_polygon({}).empty());
  }
  return polygons;
}

Polygons ring(int degree) {
  std::vector<int> face(static_cast<std::size_t>(degree));
  for (int i = 0; i < degree; ++i) face[i] = i;
  return polygons_of({face});
}

double signed_area(const Points& points, const Eigen::RowVector3i& t) {
  const Vector3 a = points.row(t[0]), b = points.row(t[1]), c = points.row(t[2]);
  return (b - a).cross(c - a).z() / 2;
}

/// Every triangle counter-clockwise, and their areas sum to that of the polygon.
void check_tiles(const Points& points, const Triangulation& cut) {
  double polygon_area = 0, sum = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Vector3 a = points.row(i), b = points.row((i + 1) % points.rows());
    polygon_area += a.cross(b).z() / 2;
  }
  for (Eigen::Index t = 0; t < cut.triangles.rows(); ++t) {
    CHECK(signed_area(points, cut.triangles.row(t)) > 0);
    sum += signed_area(points, cut.triangles.row(t));
  }
  CHECK(cut.triangles.rows() == points.rows() - 2);
  CHECK(sum == Approx(polygon_area));
}

/// Times each directed edge occurs.
std::map<std::pair<int, int>, int> directed_edges(const Triangles& triangles) {
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) ++edges[{triangles(t, k), triangles(t, (k + 1) % 3)}];
  return edges;
}

Points star(int tips) {
  Points points(2 * tips, 3);
  for (int i = 0; i < 2 * tips; ++i) {
    const double radius = i % 2 ? 1 : 5, angle = M_PI * i / tips;
    points.row(i) << radius * std::cos(angle), radius * std::sin(angle), 0;
  }
  return points;
}

}  // namespace

TEST_CASE("polygons: triangles stay as they are") {
  const Triangulation cut = triangulate(Points::Random(4, 3), polygons_of({{0, 1, 2}, {3, 2, 1}}));
  CHECK(cut.split == 0);
  CHECK(cut.corner.empty());
  CHECK(cut.triangles.row(1) == Eigen::RowVector3i(3, 2, 1));
}

TEST_CASE("polygons: a convex quad is cut along its shorter diagonal") {
  Points points(4, 3);
  points << 0, 0, 0, 3, 0, 0, 4, 1, 0, 1, 1, 0;
  const Triangulation cut = triangulate(points, ring(4));
  CHECK(directed_edges(cut.triangles).count({1, 3}) == 1);
  check_tiles(points, cut);
}

TEST_CASE("polygons: a concave quad is cut at its reflex corner, wherever it starts") {
  Points dart(4, 3);
  dart << 0, 0, 0, 4, -3, 0, 0.5, 0, 0, 4, 3, 0;  // reflex at corner 2
  for (int shift = 0; shift < 4; ++shift) {
    Points points(4, 3);
    for (int i = 0; i < 4; ++i) points.row(i) = dart.row((i + shift) % 4);
    check_tiles(points, triangulate(points, ring(4)));
  }
}

TEST_CASE("polygons: concave polygons are tiled without folds") {
  for (const int tips : {3, 5, 40})
    check_tiles(star(tips), triangulate(star(tips), ring(2 * tips)));

  Points comb(42, 3);  // teeth: every ear hides others
  for (int i = 0; i < 40; ++i) comb.row(i) << i, (i % 2 ? 1.0 : 10.0), 0;
  comb.row(40) << 40, 0, 0;
  comb.row(41) << -1, 0, 0;
  Points reversed = comb.colwise().reverse();
  check_tiles(reversed, triangulate(reversed, ring(42)));
}

TEST_CASE("polygons: long concave polygons are tiled too, where most corners are reflex") {
  for (const int half : {8, 40, 120, 1000}) {  // of a C: an arc there and, inside, back
    Points arc(2 * half, 3);
    for (int i = 0; i < half; ++i) {
      const double angle = 6.1 * i / (half - 1);
      arc.row(i) << 10 * std::cos(angle), 10 * std::sin(angle), 0;
      arc.row(2 * half - 1 - i) << 8 * std::cos(angle), 8 * std::sin(angle), 0;
    }
    const Triangulation cut = triangulate(arc, ring(2 * half));
    CHECK(cut.overlapping == 0);
    check_tiles(arc, cut);
  }
}

TEST_CASE("polygons: triangles that overlap are told, of a polygon that crosses itself") {
  Points crossed(5, 3);
  crossed << 0, 0, 0, 4, 3, 0, 4, 0, 0, 0, 3, 0, -1, 1, 0;
  const Triangulation cut = triangulate(crossed, ring(5));
  CHECK(cut.overlapping == 1);
  MeshFile file;
  adopt_triangulation(file, cut);
  REQUIRE(file.notes.size() == 1);
  CHECK(file.notes[0].starts_with("1 face of more than four corners crosses itself"));
}

TEST_CASE("polygons: tiling does not depend on place, plane or scale") {
  const Points flat = star(6);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Vector3(1, 2, 3).normalized()).matrix();
  for (const double scale : {1e-300, 1e-20, 1.0, 1e300}) {
    const Points moved = scale * (flat * turn.transpose());
    CHECK(triangulate(moved, ring(12)).triangles == triangulate(flat, ring(12)).triangles);
  }
}

TEST_CASE("polygons: what two polygons have between the same two edges is there twice, and noted") {
  // Two quads, and two pentagons, with the edges 0-1 and 1-2 in common; 1-3 would be shorter.
  Points points(9, 3);
  points << 0, 0, 0, 5, 1, 0, 10, 0, 0, 5, 2, 0, 5, -9, 0, 3, -9, 1, 7, -9, 1, 3, 9, 1, 7, 9, 1;
  for (const auto& faces : {std::vector<std::vector<int>>{{3, 0, 1, 2}, {4, 2, 1, 0}},
                            std::vector<std::vector<int>>{{0, 1, 2, 8, 7}, {1, 0, 5, 6, 2}}}) {
    const Triangulation cut = triangulate(points, polygons_of(faces));
    CHECK(cut.doublets == std::vector<int>{1});
    const auto edges = directed_edges(cut.triangles);
    CHECK(edges.at({0, 2}) == 2);
    CHECK(edges.at({2, 0}) == 2);
    MeshFile file;
    adopt_triangulation(file, cut);
    REQUIRE(file.notes.size() == 1);
    CHECK(file.notes[0].find("about vertices 1:") != std::string::npos);
  }
}

TEST_CASE("polygons: a vertex of two polygons between different neighbours is no doublet") {
  Points points(4, 3);
  points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  CHECK(triangulate(points, ring(4)).doublets.empty());
  CHECK(triangulate(points, polygons_of({{0, 1, 2, 3}, {0, 3, 2, 1}})).doublets.size() == 4);
}

TEST_CASE("polygons: no cut runs along an edge that is there already") {
  // A prism whose side quad 0 1 4 3 has its short diagonal 0–4 as an edge of another face.
  Points points(5, 3);
  points << 0, 0, 0, 2, 0, 0, 9, 9, 9, 0, 2, 0, 1.5, 1.5, 0;
  const Triangulation cut = triangulate(points, polygons_of({{0, 4, 2}, {0, 1, 4, 3}}));
  CHECK(directed_edges(cut.triangles).count({1, 3}) + directed_edges(cut.triangles).count({3, 1}) ==
        2);
  // The same for a pentagon whose fan would use 0–2.
  Points five(6, 3);
  five << 0, 0, 0, 2, 0, 0, 3, 2, 0, 1, 3, 0, -1, 2, 0, 5, 5, 5;
  const Triangulation pentagon = triangulate(five, polygons_of({{0, 2, 5}, {0, 1, 2, 3, 4}}));
  for (const auto& [edge, count] : directed_edges(pentagon.triangles)) CHECK(count == 1);
}

TEST_CASE("polygons: a closed surface of random quads stays an oriented surface") {
  // A cube surface subdivided into quads, every vertex displaced: many quads are far from flat.
  const int n = 8;
  std::map<std::array<int, 3>, int> ids;
  std::vector<std::array<int, 3>> grid;
  const auto id = [&](std::array<int, 3> at) {
    const auto [found, is_new] = ids.try_emplace(at, static_cast<int>(grid.size()));
    if (is_new) grid.push_back(at);
    return found->second;
  };
  std::vector<std::vector<int>> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          std::vector<int> face;
          for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = i + di;
            at[(axis + 2) % 3] = j + dj;
            face.push_back(id(at));
          }
          if (side == 0) std::reverse(face.begin(), face.end());
          faces.push_back(face);
        }
  std::mt19937 random(1);
  Points points(static_cast<Eigen::Index>(grid.size()), 3);
  for (double& x : points.reshaped()) x = std::uniform_real_distribution(-1.0, 1.0)(random);
  const auto edges = directed_edges(triangulate(points, polygons_of(faces)).triangles);
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    CHECK(edges.count({edge.second, edge.first}) == 1);
  }
}

TEST_CASE("polygons: degenerate and huge polygons are cut all the same") {
  CHECK(triangulate(Points::Zero(7, 3), ring(7)).triangles.rows() == 5);
  CHECK(triangulate(Points::Constant(4, 3, 1e308), ring(4)).triangles.rows() == 2);
  const Points points = Points::Random(65536, 3);
  CHECK(triangulate(points, ring(65536)).triangles.rows() == 65534);
  Points crossing = Points::Random(300, 3);
  CHECK(triangulate(crossing, ring(300)).triangles.rows() == 298);
}

TEST_CASE("polygons: one that names a vertex twice is refused, or is one triangle that does") {
  const std::vector<std::vector<int>> good = {{0, 1, 2, 3}, {4, 5, 6}},
                                      bad = {{0, 1, 0},
                                             {0, 1, 2, 1},
                                             {4, 0, 5, 1, 5, 2, 7, 3, 4},
                                             {2, 2, 2, 2, 2}};
  for (const std::vector<int>& face : bad) {
    Polygons polygons;
    polygons.corners = face;
    CHECK(polygons.close_polygon({}) ==
          "face names a vertex twice; `sphparam map --repair=duplicates` removes such faces");
  }
  Polygons polygons;
  for (const auto& faces : {bad, good, bad})
    for (const std::vector<int>& face : faces) {
      polygons.corners.insert(polygons.corners.end(), face.begin(), face.end());
      REQUIRE(polygons.close_polygon({.repeated_corners = true}).empty());
    }
  Points points = Points::Random(8, 3);
  // Cut from 0 to 2, whatever is bad besides.
  points.topRows(4) << 1, 0, 0, 0, 3, 0, -1, 0, 0, 0, -3, 0;
  const Triangulation cut = triangulate(points, polygons);
  const Triangles of_good = triangulate(points, polygons_of(good)).triangles;
  CHECK(cut.polygon == std::vector<int>{0, 1, 2, 3, 4, 4, 5, 6, 7, 8, 9});
  CHECK(cut.triangles.middleRows(4, 3) == of_good);
  for (const Eigen::Index t : {0, 1, 2, 3, 7, 8, 9, 10}) {
    const auto row = cut.triangles.row(t);
    CHECK((row[0] == row[1] || row[1] == row[2] || row[2] == row[0]));
    for (int k = 0; k < 3; ++k) CHECK(polygons.corners[cut.corner[3 * t + k]] == row[k]);
  }
}

TEST_CASE("polygons: a vertex named twice in a row counts once, where three corners are left") {
  const std::vector<std::vector<int>> written = {{0, 1, 2, 2}, {3, 3, 4, 5},
                                                 {5, 6, 7, 5}, {0, 1, 1, 1, 2, 3},
                                                 {4, 5, 5, 4}, {0, 1, 2, 0, 3, 3},
                                                 {5, 6, 7}},
                                      meant = {{0, 1, 2}, {3, 4, 5}, {6, 7, 5}, {0, 1, 2, 3}};
  Polygons polygons;
  for (const std::vector<int>& face : written) {
    polygons.corners.insert(polygons.corners.end(), face.begin(), face.end());
    REQUIRE(polygons.close_polygon({.repeated_corners = true}).empty());
  }
  const Points points = star(4);
  const Triangulation cut = triangulate(points, polygons);
  CHECK(cut.polygon == std::vector<int>{0, 1, 2, 3, 3, 4, 5, 6});
  CHECK(cut.triangles.topRows(5) == triangulate(points, polygons_of(meant)).triangles);
  for (const Eigen::Index t : {5, 6}) {
    const auto row = cut.triangles.row(t);
    CHECK((row[0] == row[1] || row[1] == row[2] || row[2] == row[0]));
  }
  for (Eigen::Index i = 0; i < cut.triangles.size(); ++i)
    CHECK(polygons.corners[cut.corner_of(i)] == cut.triangles.data()[i]);
  CHECK(cut.split == 6);
  CHECK(cut.shortened == 5);
  MeshFile file;
  adopt_triangulation(file, cut);
  CHECK(file.notes.at(0) == "5 faces name a vertex twice in a row: taken once");
}

TEST_CASE("polygons: triangles that are more or fewer than theirs are told") {
  const Polygons polygons = polygons_of({{0, 1, 2}, {0, 2, 3}});
  Triangles triangles(3, 3);
  triangles << 0, 1, 2, 0, 2, 3, 0, 3, 1;
  CHECK(corners_in(triangles.topRows(2), polygons) == std::vector<int>{0, 1, 2, 3, 4, 5});
  CHECK_THROWS_AS(corners_in(triangles, polygons), std::logic_error);
  CHECK_THROWS_AS(corners_in(triangles.topRows(1), polygons), std::logic_error);
}

TEST_CASE("polygons: two quads of which one names a vertex twice are no doublet") {
  Polygons polygons;
  for (const int v : {0, 1, 2, 3, 0, 3, 2, 3}) {
    polygons.add_corner(v);
    if (polygons.open_degree() == 4)
      REQUIRE(polygons.close_polygon({.repeated_corners = true}).empty());
  }
  CHECK(triangulate(Points::Random(4, 3), polygons).doublets.empty());
}
