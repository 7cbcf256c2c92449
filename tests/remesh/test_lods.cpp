#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "sphparam/io/fillers.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/remesh/levels_of_detail.h"
#include "support/test_meshes.h"

using namespace sphparam;

TEST_CASE("levels of detail: the coarser grid's vertices are the finer one's first, bit for bit") {
  for (const char* name : {"ico:3", "octa:17", "cube:8"}) {
    const SphereGrid fine = make_grid(parse_grid(name));
    for (int halvings = 1; halvings <= 3; ++halvings) {
      INFO(name << ", " << halvings);
      const std::optional<GridSpec> spec = coarser_grid(parse_grid(name), halvings);
      REQUIRE(spec);
      const SphereGrid coarse = make_grid(*spec);
      CHECK(coarse.faces.count() << 2 * halvings == fine.faces.count());
      CHECK(coarse.directions == fine.directions.topRows(coarse.directions.rows()));
    }
    CHECK_FALSE(coarser_grid(parse_grid(name), 4));
  }
}

TEST_CASE("levels of detail: what was not made by halving has none") {
  for (const char* name : {"ico:f=8", "octa:7", "cube:6", "uv:16x8", "healpix:4"}) {
    INFO(name);
    CHECK_FALSE(coarser_grid(parse_grid(name), 1));
  }
  CHECK(name_of(*coarser_grid(parse_grid("ico:7"), 2)) == "ico:5");
  CHECK(name_of(*coarser_grid(parse_grid("octa:129"), 3)) == "octa:17");
  CHECK(name_of(*coarser_grid(parse_grid("cube:64"), 1)) == "cube:32");
}

TEST_CASE("levels of detail: the coarsest grid within a distance, to the last bit of it") {
  MeshFile file;
  file.mesh = tests::icosphere(4);
  const SphereMap map{file.mesh.positions};
  file.mesh.positions.col(2) *= 1.3;
  const MappedMesh mapped({.file = file, .map = map});
  const Remeshed made = remesh(mapped, parse_grid("ico:2"));
  const double max = measure_distance(mapped.mesh(), made.mesh()).max();
  const GridWithin found = coarsest_grid_within(mapped, max, {.threads = 2});
  CHECK(name_of(found.grid) == "ico:2");
  CHECK(found.max == max);
  CHECK(found.holds());
  CHECK(name_of(coarsest_grid_within(mapped, std::nextafter(max, 0)).grid) == "ico:3");
  CHECK(coarsest_grid_within(mapped, 100).grid.size == 0);
  CHECK_THROWS_AS(coarsest_grid_within(mapped, -1), std::invalid_argument);
}

TEST_CASE("levels of detail: of any mesh, each with a quarter of the vertices, on its sphere") {
  MeshFile file;
  file.mesh = tests::icosphere(4);
  const SphereMap map{file.mesh.positions};
  file.mesh.positions.col(2) *= 1.3;
  const MappedMesh mapped(
      {.file = file, .map = map, .provenance = {{"method", "given"}}, .name = "egg.obj"});
  const std::vector<MappedMesh> coarser = quartered_meshes(mapped, 3);
  REQUIRE(coarser.size() == 3);
  auto finer = static_cast<double>(mapped.mesh().vertex_count());
  for (const MappedMesh& mesh : coarser) {
    const auto vertices = static_cast<double>(mesh.mesh().vertex_count());
    CHECK(vertices == Approx(finer / 4).epsilon(0.1));
    CHECK(mesh.certificate().bijective());
    CHECK(mesh.name() == "egg.obj");
    CHECK(mesh.provenance() == mapped.provenance());
    finer = vertices;
  }
  const std::vector<LevelOfDetail> measured =
      levels_of_detail(mapped, std::vector<GridSpec>{parse_grid("ico:3"), parse_grid("ico:2")});
  for (const LevelOfDetail& level : measured) {
    const LevelOfDetail::Distance distance = distance_of_level(mapped, level.mesh);
    CHECK(distance.rms == level.distance->rms);
    CHECK(distance.max == level.distance->max);
  }
  CHECK(distance_of_level(mapped, coarser[1]).rms > distance_of_level(mapped, coarser[0]).rms);
  CHECK(quartered_meshes(mapped, 0).empty());
  const std::vector<MappedMesh> all = quartered_meshes(mapped, 8);
  REQUIRE(all.size() == 4);
  CHECK(all.back().mesh().vertex_count() == 12);
  CHECK(quartered_meshes(all.back(), 2).empty());
}

TEST_CASE(
    "levels of detail: distances are from the surface, and of a fit from all, as it has no hole") {
  MeshFile file;
  file.mesh = tests::icosphere(4);
  const SphereMap map{file.mesh.positions};
  FillerMarks fillers;
  for (Face f = 0; f < file.mesh.face_count(); ++f)
    fillers.push_back(file.mesh.positions(file.mesh.triangles(f, 0), 2) > 0.7);
  file.mesh.positions.col(2) *= 1.3;
  // What closes the hole is a spike, far from all grids.
  for (auto p : file.mesh.positions.rowwise())
    if (p[2] > 1.25) p[2] = 3;
  const MappedMesh whole({.file = file, .map = map, .name = "whole"});
  mark_fillers(file, fillers);
  const MappedMesh open({.file = file, .map = map, .name = "open"});
  const std::vector<GridSpec> grids = {parse_grid("ico:3"), parse_grid("ico:2")};
  const auto distance = [&](const MappedMesh& mesh, std::optional<Scheme> scheme, size_t level) {
    return levels_of_detail(mesh, grids, {.subdivision = scheme, .threads = 1})
        .at(level)
        .distance.value();
  };
  CHECK(distance(whole, {}, 1).rms > distance(whole, {}, 0).rms);
  CHECK(distance(open, {}, 0).max < 0.5);  // nothing of the spike
  CHECK(distance(open, Scheme::Loop, 1).rms == Approx(distance(whole, Scheme::Loop, 1).rms));
  CHECK_FALSE(levels_of_detail(whole, grids, {.measure = false}).front().distance);
}

TEST_CASE("levels of detail: areas of a grid are the first one's, and of its size") {
  const TriangleMesh ball = tests::icosphere(3);
  const MappedMesh source({.file = {.mesh = ball}, .map = {ball.positions}});
  const std::vector<GridSpec> grids = {parse_grid("ico:2"), parse_grid("ico:1")};
  const auto levels = [&](Eigen::Index areas, bool made_before) {
    const LevelOptions options{
        .sample = SampleMode::AdapBaryArea, .grid_areas = VectorX::Ones(areas), .measure = false};
    const std::span<const GridSpec> all = grids;
    return made_before
               ? levels_of_detail(source, make_grid(grids[0]), all.subspan(1), options).size()
               : levels_of_detail(source, all, options).size();
  };
  for (const bool made_before : {false, true}) {
    CHECK(levels(162, made_before) == 2);
    for (const Eigen::Index wrong : {42, 161})
      CHECK_THROWS_AS(levels(wrong, made_before), std::invalid_argument);
  }
}

TEST_CASE("levels of detail: an unknown scheme is refused before any work") {
  const TriangleMesh ball = tests::icosphere(1);
  const MappedMesh source({.file = {.mesh = ball}, .map = {ball.positions}});
  const std::vector<GridSpec> grids = {parse_grid("ico:1")};
  CHECK_THROWS_AS(levels_of_detail(source, grids,
                                   {.subdivision = static_cast<Scheme>(2),
                                    .progress = [](std::string_view, double) { return false; }}),
                  std::invalid_argument);
}
