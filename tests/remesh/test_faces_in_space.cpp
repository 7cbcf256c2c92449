#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/faces_in_space.h"
#include "sphparam/remesh/remesh.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

namespace sphparam::tests {
namespace {

using Catch::Contains;

/// A bracket's L, extruded, of 20 large triangles: 80 × 60 × 25, walls 8 thick.
TriangleMesh bracket() {
  constexpr int n = 6, notch = 3;
  const std::array<std::array<double, 2>, n> outline{
      {{0, 0}, {80, 0}, {80, 8}, {8, 8}, {8, 60}, {0, 60}}};
  TriangleMesh mesh{Points(2 * n, 3), Triangles(4 * n - 4, 3)};
  Face f = 0;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    const auto& [u, v] = outline[static_cast<size_t>(i)];
    mesh.positions.row(i) << u, v, 0;
    mesh.positions.row(n + i) << u, v, 25;
    mesh.triangles.row(f++) << i, j, n + j;
    mesh.triangles.row(f++) << i, n + j, n + i;
    if (i == notch || j == notch) continue;
    mesh.triangles.row(f++) << notch, j, i;
    mesh.triangles.row(f++) << n + notch, n + i, n + j;
  }
  return mesh;
}

/// Each triangle cut into four, flat.
TriangleMesh in_four(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Vector3> places;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) places.push_back(mesh.position(v));
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(places.size()));
    if (is_new) places.emplace_back((mesh.position(a) + mesh.position(b)) / 2);
    return entry->second;
  };
  TriangleMesh fine{{}, Triangles(4 * mesh.face_count(), 3)};
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.row(4 * f) << a, ab, ca;
    fine.triangles.row(4 * f + 1) << ab, b, bc;
    fine.triangles.row(4 * f + 2) << ca, bc, c;
    fine.triangles.row(4 * f + 3) << ab, bc, ca;
  }
  fine.positions.resize(std::ssize(places), 3);
  for (size_t v = 0; v < places.size(); ++v)
    fine.positions.row(static_cast<Eigen::Index>(v)) = places[v];
  return fine;
}

/// As `remesh` of the program maps it.
MappedMesh mapped(const TriangleMesh& mesh) {
  MeshSource source;
  source.file.mesh = mesh;
  LoadOptions options;
  options.map.energy.lambda = remeshing_lambda;
  return mapped_mesh(source, options);
}

}  // namespace

TEST_CASE("faces in space: a ball on a grid lies well") {
  const TriangleMesh ball = icosphere(4);
  const MappedMesh source = tests::mapped(ball, SphereMap{ball.positions});
  const Remeshed made = remesh(source, make_grid(parse_grid("ico:3")));
  const FacesInSpace found = faces_in_space(source, made);
  CHECK(found.all_well());
  CHECK(found.area_share == 0);
  CHECK(warning_of(found, source, made).empty());
}

TEST_CASE("faces in space: a vertex drawn over its neighbour turns two triangles over") {
  const TriangleMesh ball = icosphere(3);
  const MappedMesh source = tests::mapped(ball, SphereMap{ball.positions});
  TriangleMesh drawn = ball;
  const Vertex v = ball.triangles(700, 0), over = ball.triangles(700, 1);
  drawn.positions.row(v) =
      (ball.position(over) + 0.5 * (ball.position(over) - ball.position(v))).normalized();
  const MappedMesh made = tests::mapped(drawn, SphereMap{ball.positions});
  const FacesInSpace found = faces_in_space(source, made);
  CHECK(found.turned_over == 2);
  CHECK(found.crossings.pairs > 0);
  CHECK(found.faces >= found.crossings.faces);
  CHECK(found.source_pairs == 0);
  CHECK((found.area_share > 0 && found.area_share < 0.05));
  CHECK_THAT(warning_of(found, source, made), Contains("2 are turned over"));
}

TEST_CASE(
    "faces in space: an L of large triangles comes out inverted, one of small ones does not") {
  const TriangleMesh large = bracket();
  const auto on_grid = [](const TriangleMesh& mesh) {
    const MappedMesh source = mapped(mesh);
    const Remeshed made = remesh(source, make_grid(parse_grid("ico:3")));
    FacesInSpace found = faces_in_space(source, made);
    return std::pair(std::move(found), warning_of(found, source, made));
  };
  const auto [found, warning] = on_grid(large);
  CHECK(found.faces > 0);
  CHECK(found.crossings.pairs > 0);
  CHECK(found.turned_over > 0);
  CHECK_THAT(warning, Contains("of 1280 triangles") && Contains("map the mesh with --max-edge "));
  const auto [cut, nothing] = on_grid(in_four(in_four(in_four(large))));
  CHECK(cut.all_well());
  CHECK(nothing.empty());
}

TEST_CASE("faces in space: smaller triangles are no advice for a rod") {
  const auto advice_for = [](double length) {
    TriangleMesh rod = bracket();
    rod.positions.col(2) *= length;
    const MappedMesh source = mapped(rod);
    const Remeshed made = remesh(source, make_grid(parse_grid("ico:3")));
    return warning_of(faces_in_space(source, made), source, made);
  };
  CHECK_THAT(advice_for(200), Contains("on a finer grid, or with a smaller --lambda"));
  CHECK_THAT(advice_for(1), Contains("map the mesh with --max-edge "));
}

TEST_CASE("faces in space: an adapted map folds next to nothing of a part with flat sides") {
  const MappedMesh cut = mapped(in_four(in_four(in_four(in_four(bracket())))));
  const auto share_of = [&](const MappedMesh& source) {
    return faces_in_space(source, remesh(source, make_grid(parse_grid("ico:4")))).area_share;
  };
  CHECK(share_of(cut) == 0);
  CHECK(share_of(adapt_map(cut, 2562).mapped) < 0.002);  // 0.13 where flat sides had a tenth
}

TEST_CASE("faces in space: of an adapted map the warning says to leave that out") {
  const MappedMesh source = adapt_map(mapped(bracket()), 642).mapped;
  const Remeshed made = remesh(source, make_grid(parse_grid("ico:3")));
  const FacesInSpace found = faces_in_space(source, made);
  CHECK(found.faces > 0);
  CHECK_THAT(warning_of(found, source, made), Contains("leave out --adaptive"));
}

TEST_CASE("faces in space: quads with a negative Jacobian are counted, whatever their triangles") {
  const MappedMesh source = mapped(bracket());
  const Remeshed made = remesh(source, make_grid(parse_grid("cube:32")));
  const FacesInSpace found = faces_in_space(source, made);
  CHECK(found.concave_quads == 47);
  CHECK_FALSE(found.all_well());
  CHECK_THAT(warning_of(found, source, made),
             Contains("; 47 quads are concave (a corner's Jacobian is negative)): what is proved"));
  const TriangleMesh ball = icosphere(4);
  const MappedMesh round = tests::mapped(ball, SphereMap{ball.positions});
  CHECK(faces_in_space(round, remesh(round, make_grid(parse_grid("cube:16")))).all_well());
}

TEST_CASE("faces in space: a concave quad is told also where its triangles lie well") {
  const TriangleMesh ball = icosphere(4);
  const MappedMesh source = tests::mapped(ball, SphereMap{ball.positions});
  const Remeshed made = remesh(source, make_grid(parse_grid("cube:8")));
  MeshFile file = made.file();
  const std::span<const int> quad = made.faces().polygon(100);
  const auto is_cut_at = [&](Vertex v) {
    return (made.mesh().triangles.row(200).array() == v).any() &&
           (made.mesh().triangles.row(201).array() == v).any();
  };
  const size_t k = is_cut_at(quad[0]) ? 0 : 1;  // drawn along the cut, past the other diagonal
  file.mesh.positions.row(quad[k]) =
      0.4 * file.mesh.position(quad[k]) + 0.6 * file.mesh.position(quad[(k + 2) % 4]);
  const MappedMesh drawn({.file = file, .map = made.map(), .polygons = made.polygons()});
  const FacesInSpace found = faces_in_space(source, drawn);
  CHECK(found.concave_quads == 1);
  CHECK(found.faces == 0);
  CHECK_THAT(warning_of(found, source, drawn),
             Contains("mesh: of 384 faces 1 quad is concave (a corner's Jacobian is negative): "));
}

TEST_CASE("faces in space: of a surface that crosses itself its pairs are told") {
  TriangleMesh folded = icosphere(4);
  for (Vertex v = 0; v < folded.vertex_count(); ++v) {  // the cap at the top comes out below
    double& z = folded.positions(v, 2);
    if (z > 0.9) z = -3;
  }
  const MappedMesh source = tests::mapped(folded, SphereMap{icosphere(4).positions});
  const FacesInSpace found = faces_in_space(source, source);
  CHECK(found.crossings.pairs > 0);
  CHECK(found.source_pairs == found.crossings.pairs);
  CHECK(found.turned_over == 0);
  CHECK_THAT(warning_of(found, source, source),
             Contains("the mesh itself has " + std::to_string(found.source_pairs) +
                      " pairs that cross; a map bends at the sides of large triangles: "));
  const MappedMesh whole = tests::mapped(icosphere(4), SphereMap{icosphere(4).positions});
  CHECK_THAT(warning_of(faces_in_space(whole, source), whole, source),
             Contains("the map; on a finer grid, or with a smaller --lambda of the map, "));
}

}  // namespace sphparam::tests
