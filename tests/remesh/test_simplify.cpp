#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "sphparam/errors.h"
#include "sphparam/io/fillers.h"
#include "sphparam/remesh/levels_of_detail.h"
#include "sphparam/remesh/simplify.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

using Longs = std::vector<long>;

/// 5,120 triangles, longer than wide, with a number a vertex.
MeshFile egg_file() {
  MeshFile file;
  file.mesh = tests::icosphere(4);
  file.mesh.positions.col(2) *= 1.3;
  Property number{.name = "number", .values = {}};
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) number.values.push_back(v);
  file.vertex_properties = {number};
  file.comments = {"up axis y"};
  return file;
}

MappedMesh mapped_egg(const MeshFile& file) {
  return MappedMesh({.file = file,
                     .map = {tests::icosphere(4).positions},
                     .provenance = {{"method", "given"}},
                     .name = "egg.obj"});
}

/// Of a level's vertices, in the mesh that it was made of.
std::vector<Vertex> numbers_of(const MappedMesh& level) {
  const Property& number = *level.file().find_vertex_property("number");
  return {number.values.begin(), number.values.end()};
}

/// Vertices with a filler and a triangle of the surface about them.
std::set<Vertex> rim_of(const MappedMesh& mesh) {
  std::map<Vertex, int> kinds;
  for (Face f = 0; f < mesh.mesh().face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      kinds[mesh.mesh().triangles(f, k)] |= mesh.fillers()[static_cast<size_t>(f)] != 0 ? 1 : 2;
  std::set<Vertex> rim;
  for (const auto& [v, kind] : kinds)
    if (kind == 3) rim.insert(v);
  return rim;
}

}  // namespace

TEST_CASE("simplify: a quarter each, down to an icosahedron's triangles") {
  CHECK(quarters(320, 8) == Longs{80, 20});
  CHECK(quarters(1000, 2) == Longs{250, 62});
  CHECK(quarters(1000, 9) == Longs{250, 62, 20});
  CHECK(quarters(20, 1).empty());
  CHECK(quarters(320, 0).empty());
}

TEST_CASE("simplify: as many triangles as wanted, vertices of the mesh with their rays, nested") {
  const MappedMesh egg = mapped_egg(egg_file());
  const std::vector<MappedMesh> levels = simplified_meshes(egg, Longs{1280, 320, 20});
  REQUIRE(levels.size() == 3);
  CHECK(levels[0].mesh().face_count() == 1280);
  CHECK(levels[1].mesh().face_count() == 320);
  CHECK(levels[2].mesh().face_count() == 20);
  std::vector<Vertex> finer;
  for (const MappedMesh& level : levels) {
    CHECK(level.certificate().bijective());
    CHECK(level.name() == "egg.obj");
    CHECK(level.provenance() == egg.provenance());
    CHECK(level.file().comments == egg.file().comments);
    const std::vector<Vertex> numbers = numbers_of(level);
    CHECK(level.map().points == Points(egg.map().points(numbers, Eigen::all)));
    CHECK(level.mesh().positions == Points(egg.mesh().positions(numbers, Eigen::all)));
    if (!finer.empty())
      CHECK(std::includes(finer.begin(), finer.end(), numbers.begin(), numbers.end()));
    finer = numbers;
  }
}

TEST_CASE("simplify: of a surface with edges far nearer to it than a grid of as many triangles") {
  MeshFile file = egg_file();
  for (double& x : file.mesh.positions.reshaped()) x = std::clamp(x, -0.6, 0.6);
  const MappedMesh block = mapped_egg(file);
  const MappedMesh grid = quartered_meshes(block, 1).back();
  const MappedMesh level = simplified_meshes(block, Longs{grid.mesh().face_count()}).front();
  CHECK(level.mesh().face_count() <= grid.mesh().face_count());
  CHECK(distance_of_level(block, level).rms < distance_of_level(block, grid).rms / 2);
}

TEST_CASE("simplify: vertices at the poles stay") {
  MeshFile file = egg_file();
  TriangleMesh ball = tests::icosphere(4);
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(ball.position(7), Vector3(0, 0, 1)).toRotationMatrix();
  for (auto p : ball.positions.rowwise()) p = (turn * p.transpose()).transpose().eval();
  ball.positions.row(7) << 0, 0, 1;
  const MappedMesh egg({.file = file, .map = {ball.positions}});
  const std::vector<Vertex> numbers = numbers_of(simplified_meshes(egg, Longs{40}).front());
  CHECK(std::ranges::count(numbers, 7) == 1);
}

TEST_CASE("simplify: fillers stay fillers, and their rim is made of vertices of the rim") {
  MeshFile file = egg_file();
  FillerMarks fillers;
  for (Face f = 0; f < file.mesh.face_count(); ++f)
    fillers.push_back(file.mesh.positions(file.mesh.triangles(f, 0), 2) > 0.9);
  mark_fillers(file, fillers);
  const MappedMesh egg = mapped_egg(file);
  const std::set<Vertex> rim = rim_of(egg);
  const MappedMesh level = simplified_meshes(egg, Longs{400}).front();
  CHECK(level.mesh().face_count() == 400);
  const std::vector<Vertex> numbers = numbers_of(level);
  const std::set<Vertex> left = rim_of(level);
  CHECK(left.size() >= 3);
  CHECK(left.size() < rim.size());
  for (const Vertex v : left) CHECK(rim.contains(numbers[static_cast<size_t>(v)]));
}

TEST_CASE("simplify: holes of three edges stay holes") {
  MeshFile file = egg_file();
  FillerMarks fillers(static_cast<size_t>(file.mesh.face_count()), 0);
  std::set<Vertex> taken;  // holes have no vertex in common
  long holes = 0;
  for (Face f = 0; f < file.mesh.face_count(); f += 41) {
    const auto corners = file.mesh.triangles.row(f);
    if (std::ranges::any_of(corners, [&](Vertex v) { return taken.contains(v); })) continue;
    taken.insert(corners.begin(), corners.end());
    fillers[static_cast<size_t>(f)] = 1;
    ++holes;
  }
  REQUIRE(holes > 10);
  mark_fillers(file, fillers);
  const MappedMesh level = simplified_meshes(mapped_egg(file), Longs{4 * holes}).front();
  CHECK(level.mesh().face_count() < file.mesh.face_count() / 2);
  CHECK(std::ranges::count(level.fillers(), 1) == holes);
}

TEST_CASE("simplify: what cannot be coarser is left out, and numbers must fall") {
  const TriangleMesh four = tests::tetrahedron();
  const MappedMesh least({.file = {.mesh = four}, .map = {four.positions}});
  CHECK(simplified_meshes(least, Longs{4}).empty());
  CHECK_THROWS_AS(simplified_meshes(least, Longs{3}), std::invalid_argument);
  CHECK_THROWS_AS(simplified_meshes(least, Longs{8, 8}), std::invalid_argument);
  const MappedMesh egg = mapped_egg(egg_file());
  const std::vector<MappedMesh> one =
      simplified_meshes(egg, Longs{egg.mesh().face_count() + 10, egg.mesh().face_count(), 100});
  REQUIRE(one.size() == 1);
  CHECK(one[0].mesh().face_count() == 100);
  CHECK_THROWS_AS(simplified_meshes(egg, Longs{100},
                                    {.progress = [](std::string_view, double) { return false; }}),
                  Cancelled);
}
