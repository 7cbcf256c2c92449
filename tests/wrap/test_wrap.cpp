#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/vertex_normals.h"
#include "sphparam/errors.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/wrap/wrap.h"
#include "support/cube.h"
#include "support/joined.h"
#include "support/test_meshes.h"
#include "support/torus.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

TriangleMesh moved(TriangleMesh mesh, const Vector3& by) {
  mesh.positions.rowwise() += by.transpose();
  return mesh;
}

TriangleMesh hoop(double large, double small) { return torus(48, 24, large, small); }

TriangleMesh sheet() {
  TriangleMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.positions << 0, 0, 0, 3, 0, 0, 3, 2, 1, 0, 2, 1;
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

/// Laws of every wrap that was not carved.
void check_shell(const Wrap& wrap) {
  CHECK(inspect_mesh(wrap.mesh).defects.empty());
  CHECK(wrap.outside == 0);
  CHECK(wrap.apart.forth.max_bound < wrap.distance + wrap.voxel);
  CHECK(wrap.apart.forth.min > wrap.distance - wrap.voxel);
}

}  // namespace

TEST_CASE("wrap: a sphere lies within a voxel of the distance, outside and in one piece") {
  for (const double distance : {0.1, 0.2, 0.5}) {
    const Wrap wrap = wrap_soup(icosphere(4), {.voxel = 0.1, .distance = distance});
    check_shell(wrap);
    CHECK(wrap.parts == 1);
    CHECK(wrap.handles == 0);
    CHECK(wrap.insides == 1);
    CHECK(wrap.cavities == 0);
    CHECK(wrap.gap == wrap.distance);
    CHECK(wrap.added_share == 0);
    CHECK(wrap.soup_vertices == icosphere(4).vertex_count());
    const double radius = 1 + distance;
    CHECK(inspect_mesh(wrap.mesh).volume ==
          Approx(4 * std::numbers::pi / 3 * radius * radius * radius).epsilon(0.01));
  }
}

TEST_CASE("wrap: an open sheet is enclosed from both sides") {
  const Wrap wrap = wrap_soup(sheet(), {.resolution = 40});
  CHECK(wrap.voxel == Approx(3.0 / 40));
  CHECK(wrap.distance == Approx(6.0 / 40));
  CHECK(wrap.cavities == 0);
  check_shell(wrap);
}

TEST_CASE("wrap: of an open ball a skin is solid, until the distance closes what is open") {
  TriangleMesh open = icosphere(4);
  Eigen::Index kept = 0;  // below an opening of radius 0.4
  for (Face f = 0; f < open.face_count(); ++f)
    if (open.position(open.triangles(f, 0)).z() < 0.9165)
      open.triangles.row(kept++) = open.triangles.row(f);
  open.triangles.conservativeResize(kept, 3);
  const Wrap skin = wrap_soup(open, {.voxel = 0.05, .distance = 0.1});
  CHECK(skin.skin);
  CHECK(skin.volume == inspect_mesh(skin.mesh).volume);
  CHECK(skin.area == inspect_mesh(skin.mesh).area);
  CHECK(skin.soup_area == inspect_mesh(open).area);
  CHECK(skin.volume == Approx(0.2 * skin.soup_area).epsilon(0.05));
  const double closing = closing_distance(open, 0.1, 1);
  CHECK(closing == 0.38);
  CHECK(closing_distance(open, 0.1, 2) == closing);
  const Wrap body = wrap_soup(open, {.voxel = 0.05, .distance = closing});
  CHECK_FALSE(body.skin);
  CHECK(body.insides == 1);
  const double radius = 1 + closing;
  CHECK(body.volume == Approx(4 * std::numbers::pi / 3 * radius * radius * radius).epsilon(0.03));
  CHECK_FALSE(wrap_soup(icosphere(3), {.resolution = 40}).skin);
  CHECK(wrap_soup(sheet(), {.resolution = 40}).skin);
  CHECK(closing_distance(sheet(), 6.0 / 40) == 0);
}

TEST_CASE("wrap: triangles that pass through one another, turned inside out, and needles") {
  TriangleMesh soup = joined(icosphere(2), moved(icosphere(2), {0.7, 0.1, 0}));
  soup.triangles.row(0).reverseInPlace();
  soup.triangles.row(5) = soup.triangles.row(7);
  soup.triangles(9, 0) = soup.triangles(9, 1);
  const Wrap wrap = wrap_soup(soup, {.resolution = 30});
  check_shell(wrap);
  CHECK(wrap.parts == 1);
}

TEST_CASE("wrap: the hole of a torus is closed by a wall, and told") {
  const TriangleMesh soup = hoop(1, 0.3);
  const Wrap wrap = wrap_soup(soup, {.voxel = 0.05, .distance = 0.1});
  CHECK(inspect_mesh(wrap.mesh).defects.empty());
  CHECK(wrap.handles == 1);
  CHECK(wrap.outside == 0);
  CHECK(wrap.added_share > 0);
  CHECK(wrap.apart.forth.min > wrap.distance - wrap.voxel);
  // A disc through the middle of the hole, whose radius is 0.7.
  CHECK(wrap.apart.forth.max == Approx(0.7).margin(0.05));
  CHECK(std::abs(wrap.apart.forth.farthest.z()) < 1.5 * wrap.voxel);
  const double disc = std::numbers::pi * 0.6 * 0.6 * wrap.voxel;
  const double ring = 2 * std::numbers::pi * std::numbers::pi * 0.4 * 0.4;
  CHECK(inspect_mesh(wrap.mesh).volume == Approx(ring + disc).epsilon(0.03));
}

TEST_CASE("wrap: at a distance that closes the hole there is none") {
  const Wrap wrap = wrap_soup(hoop(1, 0.3), {.voxel = 0.1, .distance = 0.75});
  CHECK(wrap.handles == 0);
  check_shell(wrap);
}

TEST_CASE("wrap: what is apart is joined by a bridge, or the largest is kept, both are told") {
  const TriangleMesh soup = joined(icosphere(2), moved(hoop(0.3, 0.15), {3, 0, 0}));
  const Wrap joined = wrap_soup(soup, {.voxel = 0.08});
  CHECK(inspect_mesh(joined.mesh).defects.empty());
  CHECK(joined.parts == 2);
  CHECK(joined.handles == 0);  // the hole is narrower than both distances
  CHECK(joined.outside == 0);
  CHECK(joined.kept_share == 1);
  CHECK(joined.added_share > 0);
  CHECK(joined.added_share < 0.02);

  const Wrap largest = wrap_soup(soup, {.voxel = 0.08, .largest = true});
  check_shell({.mesh = largest.mesh,
               .voxel = largest.voxel,
               .distance = largest.distance,
               .apart = largest.apart});
  CHECK(largest.parts == 2);
  CHECK(largest.outside == hoop(0.3, 0.15).vertex_count());
  CHECK(largest.kept_share > 0.85);
  CHECK(largest.kept_share < 0.95);
  CHECK(largest.added_share == 0);
  CHECK(largest.mesh.positions.col(0).maxCoeff() < 1.5);
}

TEST_CASE("wrap: a void within a solid is a cavity, its outside an inside") {
  TriangleMesh within = icosphere(3);
  within.positions *= 0.5;
  within.triangles.col(0).swap(within.triangles.col(1));
  const Wrap hollow = wrap_soup(joined(icosphere(3), within), {.voxel = 0.05});
  CHECK(hollow.insides == 1);
  CHECK(hollow.cavities == 1);
  within.triangles.col(0).swap(within.triangles.col(1));
  const Wrap filled = wrap_soup(joined(icosphere(3), within), {.voxel = 0.05});
  CHECK(filled.insides == 2);
  CHECK(filled.cavities == 0);
}

TEST_CASE("wrap: drawn in to the gap, where no wall is") {
  const Wrap ball = wrap_soup(icosphere(4), {.voxel = 0.1, .gap = 0.01});
  CHECK(ball.gap == 0.01);
  CHECK(ball.distance == 0.2);
  CHECK(inspect_mesh(ball.mesh).defects.empty());
  CHECK(ball.mesh.triangles == wrap_soup(icosphere(4), {.voxel = 0.1}).mesh.triangles);
  CHECK(ball.apart.forth.at_vertices.minCoeff() > 0.99 * ball.gap);
  CHECK(ball.apart.forth.at_vertices.maxCoeff() < 1.06 * ball.gap);
  CHECK(inspect_mesh(ball.mesh).volume == Approx(4 * std::numbers::pi / 3).epsilon(0.03));

  const Wrap flat = wrap_soup(sheet(), {.voxel = 0.05, .gap = 0.005});
  CHECK(inspect_mesh(flat.mesh).defects.empty());
  CHECK(flat.apart.forth.at_vertices.maxCoeff() < 1.06 * flat.gap);
  CHECK(flat.apart.back.max < 0.02);

  const Wrap ring = wrap_soup(hoop(1, 0.3), {.voxel = 0.05, .distance = 0.1, .gap = 0.01});
  CHECK(ring.handles == 1);
  CHECK(ring.apart.forth.max == Approx(0.7).margin(0.05));  // the wall stays
  const double disc = std::numbers::pi * 0.7 * 0.7 * ring.voxel;
  const double body = 2 * std::numbers::pi * std::numbers::pi * 0.3 * 0.3;
  CHECK(inspect_mesh(ring.mesh).volume == Approx(body + disc).epsilon(0.05));

  CHECK_THROWS_AS(wrap_soup(sheet(), {.voxel = 0.1, .distance = 0.2, .gap = 0.3}),
                  std::invalid_argument);
}

TEST_CASE("wrap: drawn in, vertices go along their normals, but for corners of turned triangles") {
  std::vector<std::string> stages;
  const auto tell = [&](std::string_view stage, double) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    return true;
  };
  const TriangleMesh before = wrap_soup(sheet(), {.voxel = 0.1}).mesh;
  const Wrap drawn = wrap_soup(sheet(), {.voxel = 0.1, .gap = 0.01, .progress = tell});
  CHECK(std::ranges::count(stages, "draw in") == 1);
  const Points normals = angle_weighted_normals(before);
  int elsewhere = 0;
  for (Vertex v = 0; v < before.vertex_count(); ++v) {
    const Vector3 way = drawn.mesh.position(v) - before.position(v), normal = normals.row(v);
    elsewhere += way.cross(normal).norm() > 1e-9;
  }
  CHECK(elsewhere == 2820);  // of 7620, near the rims
}

TEST_CASE("wrap: drawn in to a level plate, no vertex comes to lie on it") {
  TriangleMesh plate = sheet();
  plate.positions << 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0;
  for (const double voxel : {0.5, 0.3, 0.25}) {
    const Wrap wrap = wrap_soup(plate, {.voxel = voxel, .gap = 0.01});
    CHECK(wrap.apart.forth.at_vertices.minCoeff() > 0.5 * wrap.gap);
  }
}

TEST_CASE("wrap: drawn in, corners stay corners, to less than a voxel") {
  TriangleMesh box = cube();
  const Wrap wrap = wrap_soup(box, {.voxel = 0.05 * box.positions.maxCoeff(), .gap = 1e-3});
  const Vector3 lower = wrap.mesh.positions.colwise().minCoeff(),
                upper = wrap.mesh.positions.colwise().maxCoeff();
  const Vector3 low = box.positions.colwise().minCoeff(), high = box.positions.colwise().maxCoeff();
  CHECK((lower - low).cwiseAbs().maxCoeff() < 2e-3);
  CHECK((upper - high).cwiseAbs().maxCoeff() < 2e-3);
  CHECK(wrap.apart.back.max < wrap.voxel);
}

TEST_CASE("wrap: the same bytes for any number of threads") {
  const TriangleMesh soup = joined(hoop(1, 0.3), moved(icosphere(1), {2.9, 0.3, 0.1}));
  const Wrap one = wrap_soup(soup, {.resolution = 50, .gap = 0.01, .threads = 1});
  const Wrap two = wrap_soup(soup, {.resolution = 50, .gap = 0.01, .threads = 2});
  CHECK(one.mesh.positions == two.mesh.positions);
  CHECK(one.mesh.triangles == two.mesh.triangles);
  CHECK(one.outside == two.outside);
  CHECK(one.apart.forth.mean == two.apart.forth.mean);
}

TEST_CASE("wrap: a soup moved by voxels is wrapped alike") {
  const Wrap here = wrap_soup(hoop(1, 0.3), {.voxel = 0.0625});
  const Wrap there = wrap_soup(moved(hoop(1, 0.3), {8, -4, 16}), {.voxel = 0.0625});
  REQUIRE(here.mesh.triangles == there.mesh.triangles);
  CHECK((moved(here.mesh, {8, -4, 16}).positions - there.mesh.positions).cwiseAbs().maxCoeff() <
        1e-6);
}

TEST_CASE("wrap: what has no places, no extent, or too fine a lattice is refused") {
  TriangleMesh soup = sheet();
  soup.positions(2, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(wrap_soup(soup), MeshError);
  CHECK_THROWS_WITH(wrap_soup(soup), !Catch::Contains("closed genus-0"));  // nor need it be one
  soup = sheet();
  soup.triangles(0, 0) = 4;
  CHECK_THROWS_AS(wrap_soup(soup), MeshError);
  CHECK_THROWS_AS(wrap_soup({Points(0, 3), Triangles(0, 3)}), MeshError);
  CHECK_THROWS_AS(wrap_soup({sheet().positions, Triangles(0, 3)}), MeshError);
  CHECK_THROWS_AS(wrap_soup({Points::Zero(1, 3), Triangles::Zero(1, 3)}), UnmeasurableMesh);
  soup = sheet();
  soup.positions.setConstant(2);
  CHECK_THROWS_AS(wrap_soup(soup), UnmeasurableMesh);
  CHECK_THROWS_WITH(wrap_soup(soup), Catch::StartsWith("this mesh has no extent"));
  CHECK_THROWS_AS(wrap_soup(moved(sheet(), {1e15, 0, 0})), UnmeasurableMesh);
  CHECK_THROWS_WITH(wrap_soup(moved(sheet(), {1e15, 0, 0})),
                    Catch::Contains("is too small for coordinates up to 1e+15"));
  CHECK_THROWS_AS(wrap_soup(sheet(), {.voxel = 1e-4}), std::invalid_argument);
  CHECK_THROWS_AS(wrap_soup(sheet(), {.voxel = -1}), std::invalid_argument);
  CHECK_THROWS_AS(wrap_soup(sheet(), {.voxel = 0.1, .distance = 0.09}), std::invalid_argument);
}

TEST_CASE("wrap: a voxel or distance beyond what doubles measure is refused, what is less is not") {
  CHECK_THROWS_WITH(wrap_soup(sheet(), {.voxel = 1e300}), Catch::StartsWith("voxel is 1e+300"));
  CHECK_THROWS_WITH(wrap_soup(sheet(), {.voxel = 1, .distance = 1e200}),
                    Catch::StartsWith("distance is 1e+200"));
  for (const double voxel : {1e10, 1e70}) {
    const Wrap wrap = wrap_soup(sheet(), {.voxel = voxel, .faces = 4});
    CHECK(wrap.handles == 0);
    CHECK(wrap.outside == 0);
  }
}

TEST_CASE("wrap: whose lattice is too fine is told what would do, of the option it comes from") {
  const auto refusal = [](const WrapOptions& options) -> std::string {
    try {
      wrap_soup(sheet(), options);
    } catch (const VoxelError& error) {
      return error.what();
    }
    return "";
  };
  const auto number_in = [](const std::string& text) {
    const std::string words = "it must be about ";
    return std::stod(text.substr(text.find(words) + words.size()));
  };
  const auto begins = [](WrapOptions options) {  // with what takes time
    options.progress = [](std::string_view, double) { return false; };
    CHECK_THROWS_AS(wrap_soup(sheet(), options), Cancelled);
  };
  const std::string fine = refusal({.resolution = 50'000});
  CHECK_THAT(fine, Catch::StartsWith("resolution is 50000: ") && Catch::Contains(" or less here"));
  begins({.resolution = static_cast<int>(number_in(fine))});
  const std::string near = refusal({.distance = 1e-5});
  CHECK_THAT(near, Catch::StartsWith("distance is 1e-05: ") && Catch::Contains(" or more here"));
  begins({.distance = 1.01 * number_in(near)});
  const std::string far = refusal({.distance = 20});
  CHECK_THAT(far, Catch::StartsWith("voxel is 0.0234") && Catch::Contains(" or more here"));
  begins({.voxel = 1.01 * number_in(far), .distance = 20});
}

TEST_CASE("wrap: gives up when told to") {
  CHECK_THROWS_AS(wrap_soup(sheet(), {.progress = [](std::string_view, double) { return false; }}),
                  Cancelled);
}

}  // namespace sphparam
