#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/errors.h"
#include "sphparam/measure/surface_distance.h"
#include "support/cube.h"
#include "support/test_meshes.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

/// A flat square of n×n cells in the plane z = height.
TriangleMesh plane(int n, double height) {
  TriangleMesh mesh{Points((n + 1) * (n + 1), 3), Triangles(2 * n * n, 3)};
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) mesh.positions.row(i * (n + 1) + j) << i, j, height;
  }
  for (int i = 0, f = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j, f += 2) {
      const int v = i * (n + 1) + j;
      mesh.triangles.row(f) << v, v + n + 1, v + n + 2;
      mesh.triangles.row(f + 1) << v, v + n + 2, v + 1;
    }
  }
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  mesh.positions *= factor;
  return mesh;
}

bool same_bits(const OneSidedDistance& a, const OneSidedDistance& b) {
  return a.max == b.max && a.min == b.min && a.mean == b.mean && a.rms == b.rms &&
         a.samples == b.samples && a.farthest == b.farthest && a.at_vertices == b.at_vertices;
}

bool same_bits(const SurfaceDistance& a, const SurfaceDistance& b) {
  return same_bits(a.forth, b.forth) && same_bits(a.back, b.back);
}

}  // namespace

TEST_CASE("distance: a plane that is shifted is that far away everywhere, to the bit") {
  const SurfaceDistance distance =
      measure_distance(plane(10, 0), plane(7, 0.25), {.samples = 5000, .edges = true});
  // The smaller square lies above a part of the larger one: forth the rims stick out.
  CHECK(distance.back.max == 0.25);
  CHECK(distance.back.max_bound <= 0.25 * 1.001);
  CHECK(distance.back.min == 0.25);
  CHECK(distance.back.mean == 0.25);
  CHECK(distance.back.rms == 0.25);
  CHECK(distance.back.samples == 10000);
  CHECK(distance.forth.min == 0.25);
  CHECK(distance.forth.max == Approx(std::sqrt(9 + 9 + 0.0625)));
  CHECK(distance.forth.farthest == Vector3(10, 10, 0));
  CHECK(distance.max() == distance.forth.max);
  CHECK(distance.forth.max_bound >= distance.forth.max);
  CHECK(distance.diagonal_first == Approx(std::sqrt(200)));
  CHECK(distance.diagonal_second == Approx(std::sqrt(98)));
}

TEST_CASE("distance: what is nearest to the border of the other is left out, and its share told") {
  // Over the smaller square lie 49 of the larger one's 100 cells, and 7 × 7 vertices within its
  // rim.
  const DistanceOptions plain{.samples = 20000, .vertices = true},
      without{.samples = 20000, .vertices = true, .leave_out_borders = true};
  const SurfaceDistance distance = measure_distance(plane(10, 0), plane(7, 0.25), without);
  CHECK(distance.forth.max == 0.25);
  CHECK(distance.forth.mean == 0.25);
  CHECK(distance.forth.p99 == 0.25);
  CHECK(distance.forth.max_bound == std::numeric_limits<double>::infinity());
  const auto& marks = distance.forth.left_out_vertices;
  REQUIRE(marks.size() == 121);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      const bool is_within = i > 0 && i < 7 && j > 0 && j < 7;
      CHECK(marks[static_cast<std::size_t>(11 * i + j)] == !is_within);
    }
  CHECK(distance.forth.at_vertices[120] == Approx(std::sqrt(18.0625)));  // told all the same
  CHECK(distance.forth.left_out.value() == Approx(0.51).margin(0.005));
  CHECK(distance.forth.samples == std::llround(20121 * (1 - distance.forth.left_out.value())));
  CHECK(distance.back.max == 0.25);
  CHECK(distance.back.left_out.value() == Approx(15 / 20064.).epsilon(1e-12));  // two of its sides
  CHECK_FALSE(measure_distance(plane(10, 0), plane(7, 0.25), plain).forth.left_out);
  // A surface lies on its own border, not beyond it.
  const SurfaceDistance same = measure_distance(plane(5, 1), plane(5, 1), without);
  CHECK(same.forth.left_out == 0.0);
  CHECK(same.max() == 0);
  TriangleMesh beside = plane(3, 0);
  beside.positions.rowwise() += Eigen::RowVector3d(20, 0, 0);
  CHECK_THROWS_WITH(measure_distance(beside, plane(7, 0), without),
                    Catch::Contains("nearest to the border of the other"));
}

TEST_CASE("distance: a seam of copies is no border, a hole is one") {
  TriangleMesh ball = icosphere(2), seamed{Points(3 * ball.face_count(), 3), ball.triangles};
  for (Face f = 0; f < ball.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      seamed.positions.row(3 * f + k) = ball.positions.row(ball.triangles(f, k));
      seamed.triangles(f, k) = 3 * f + k;
    }
  const TriangleMesh inner = scaled(icosphere(3), 0.9);
  const DistanceOptions options{.samples = 20000, .leave_out_borders = true};
  CHECK(measure_distance(inner, seamed, options).forth.left_out == 0.0);
  CHECK(measure_distance(inner, ball, options).forth.left_out == 0.0);
  const int all = ball.face_count();
  ball.triangles.conservativeResize(all / 2, 3);
  const SurfaceDistance half = measure_distance(inner, ball, options);
  CHECK(half.forth.left_out.value() == Approx(0.5).margin(0.05));
  CHECK(half.forth.max < 0.11);
  CHECK(half.back.left_out == 0.0);
}

TEST_CASE("distance: concentric spheres, within what their own triangles are off") {
  const TriangleMesh inner = icosphere(4), outer = scaled(icosphere(4), 1.5);
  const double sag = 0.0021;  // of icosphere(4): 1 − the least height of a triangle over the centre
  const SurfaceDistance distance = measure_distance(inner, outer, {.samples = 20000});
  for (const OneSidedDistance& side : {distance.forth, distance.back}) {
    CHECK(side.max <= 0.5 + 1.5 * sag);
    CHECK(side.min >= 0.5 - 1.5 * sag);
    CHECK(side.mean == Approx(0.5).margin(sag));
    CHECK(side.rms == Approx(0.5).margin(sag));
    CHECK(side.rms >= side.mean);
  }
}

TEST_CASE("distance: a surface is no distance from itself, nor from a finer mesh of itself") {
  const TriangleMesh ball = icosphere(3);
  const SurfaceDistance same = measure_distance(ball, relabelled(ball, 5),
                                                {.samples = 5000, .edges = true, .vertices = true});
  CHECK(same.max() == 0);
  CHECK(same.rms() == 0);
  TriangleMesh finer = plane(12, 3);
  finer.positions /= 3;
  CHECK(measure_distance(plane(4, 1), finer, {.samples = 5000}).max() == 0);
}

TEST_CASE("distance: both ways round it is the same") {
  const TriangleMesh a = icosphere(3), b = random_sphere_mesh(200, 4);
  const SurfaceDistance ab = measure_distance(a, b, {.samples = 3000}),
                        ba = measure_distance(b, a, {.samples = 3000});
  CHECK(same_bits(ab.forth, ba.back));
  CHECK(same_bits(ab.back, ba.forth));
  CHECK(ab.max() == ba.max());
  CHECK(ab.max() >= ab.rms());
  CHECK(ab.rms() >= ab.mean());
}

TEST_CASE("distance: the same bits for any number of threads, other samples for another seed") {
  const TriangleMesh a = icosphere(3), b = scaled(icosphere(2), 1.02);
  const DistanceOptions one = {.samples = 80000, .edges = true, .threads = 1};
  DistanceOptions eight = one, other = one;
  eight.threads = 8;
  other.seed = 2;
  const SurfaceDistance result = measure_distance(a, b, one);
  CHECK(same_bits(result, measure_distance(a, b, eight)));
  CHECK_FALSE(same_bits(result, measure_distance(a, b, other)));
  CHECK(result.rms() == Approx(measure_distance(a, b, other).rms()).epsilon(0.01));
}

TEST_CASE("distance: percentiles, by nearest rank, and the share within a length") {
  // A strip whose vertices are 1, 2, … 100 above a plane, or from 50 below it to 49 above.
  TriangleMesh strip{Points(100, 3), Triangles(98, 3)};
  for (int i = 0; i < 100; ++i) strip.positions.row(i) << 0.01 * i, i % 2, i + 1;
  for (int f = 0; f < 98; ++f) strip.triangles.row(f) << f, f + 1, f + 2;
  TriangleMesh ground = plane(1, 0);
  ground.positions *= 400;
  ground.positions.leftCols(2).array() -= 200;
  DistanceOptions options{.faces = false, .vertices = true, .within = 10};
  const double deviation = std::sqrt((100.0 * 100 - 1) / 12);
  const OneSidedDistance found = measure_distance(strip, ground, options).forth;
  CHECK(found.median == 50);
  CHECK(found.p95 == 95);
  CHECK(found.p99 == 99);
  CHECK(found.sd == Approx(deviation).epsilon(1e-14));
  CHECK(found.within == 0.1);
  CHECK(measure_distance(strip, ground, options).p95() > 200);  // of the ground's corners
  CHECK_FALSE(measure_distance(strip, ground, {.samples = 9}).forth.within);
  options.within = -1;
  CHECK_THROWS_AS(measure_distance(strip, ground, options), std::invalid_argument);

  strip.positions.col(2).array() -= 51;
  TriangleMesh block = cube();
  block.positions = (block.positions.rowwise() - block.positions.colwise().mean()) * 400;
  block.positions.col(2).array() -= block.positions.col(2).maxCoeff();
  options = {.faces = false, .vertices = true, .deviations = true};
  const SignedDeviation side = measure_distance(strip, block, options).forth.deviation.value();
  CHECK(side.min == -50);
  CHECK(side.max == 49);
  CHECK(side.mean == -0.5);
  CHECK(side.median == -1);
  CHECK(side.sd == Approx(deviation).epsilon(1e-14));
}

TEST_CASE("distance: the maximum sees a spike that samples miss, and says where it is") {
  TriangleMesh spiky = icosphere(3);
  spiky.positions.row(100) *= 4;
  const SurfaceDistance distance = measure_distance(spiky, icosphere(3), {.samples = 1});
  CHECK(distance.forth.max == Approx(3).margin(1e-12));
  CHECK(distance.forth.farthest == spiky.position(100));
  CHECK(distance.forth.at_vertices[100] == distance.forth.max);
  CHECK(distance.forth.at_vertices.size() == spiky.vertex_count());
}

TEST_CASE(
    "distance: without extremes mean and RMS are the same bits, and nothing else is claimed") {
  const TriangleMesh a = icosphere(2), b = scaled(icosphere(3), 1.1);
  const SurfaceDistance full = measure_distance(a, b, {.samples = 500});
  const SurfaceDistance quick = measure_distance(a, b, {.samples = 500, .extremes = false});
  CHECK(quick.forth.rms == full.forth.rms);
  CHECK(quick.back.mean == full.back.mean);
  CHECK(quick.forth.at_vertices.size() == 0);
  CHECK(quick.forth.max <= full.forth.max);
  CHECK(quick.max_bound() == std::numeric_limits<double>::infinity());
  const DistanceOptions of_vertices{.faces = false, .vertices = true, .extremes = false};
  CHECK(measure_distance(a, b, of_vertices).forth.samples == a.vertex_count());
}

TEST_CASE("distance: vertices that no triangle uses do not count") {
  TriangleMesh ball = icosphere(2);
  ball.positions.conservativeResize(ball.vertex_count() + 1, 3);
  ball.positions.row(ball.vertex_count() - 1) << 50, 0, 0;
  const SurfaceDistance distance = measure_distance(ball, icosphere(2), {.samples = 100});
  CHECK(distance.max() == 0);
  CHECK(distance.diagonal_first < 4);
  // Nor for the size that lengths are told in.
  ball.positions(ball.vertex_count() - 1, 0) = 1e200;
  const SurfaceDistance apart =
      measure_distance(ball, scaled(icosphere(2), 2), {.faces = false, .vertices = true});
  CHECK(apart.forth.min > 0.8);
  CHECK(apart.max() == Approx(1));
  CHECK(apart.forth.at_vertices[ball.vertex_count() - 1] == Approx(1e200));
}

TEST_CASE("distance: each vertex of the only triangle counts") {
  TriangleMesh one = plane(1, 0);
  one.triangles.conservativeResize(1, 3);
  const DistanceOptions of_vertices{.faces = false, .vertices = true};
  CHECK(measure_distance(one, plane(1, 2), of_vertices).forth.samples == 3);
}

TEST_CASE("distance: progress is the share of the points of one direction") {
  std::vector<std::pair<std::string, double>> told;
  const Progress tell = [&](std::string_view stage, double share) {
    told.emplace_back(stage, share);
    return true;
  };
  const TriangleMesh first = octahedron(), second = icosphere(0);  // 6 and 12 vertices
  measure_distance(first, second, {.samples = 9, .edges = true, .progress = tell});
  CHECK(told == std::vector<std::pair<std::string, double>>{{"trees", 0},
                                                            {"trees", 0.5},
                                                            {"first to second", 0.25},
                                                            {"first to second", 0.625},
                                                            {"first to second", 1},
                                                            {"second to first", 0.4},
                                                            {"second to first", 0.7},
                                                            {"second to first", 1}});
}

TEST_CASE("distance: what mean and RMS are taken over can be chosen") {
  const TriangleMesh a = icosphere(1), b = scaled(icosphere(3), 1.1);
  const auto samples = [&](bool faces, bool edges, bool vertices) {
    return measure_distance(a, b,
                            {.samples = 50, .faces = faces, .edges = edges, .vertices = vertices})
        .forth.samples;
  };
  CHECK(samples(true, false, false) == 50);
  CHECK(samples(false, true, true) == 50 + a.vertex_count());
  CHECK(samples(true, true, true) == 100 + a.vertex_count());
  const SurfaceDistance at_vertices = measure_distance(a, b, {.faces = false, .vertices = true});
  CHECK(at_vertices.forth.mean == Approx(at_vertices.forth.at_vertices.mean()));
}

TEST_CASE("distance: surfaces as large or as small as numbers go, and a shape far from another") {
  const TriangleMesh a = icosphere(2), b = scaled(icosphere(2), 1.5);
  const SurfaceDistance unscaled = measure_distance(a, b, {.samples = 200});
  const double expected = unscaled.rms();
  for (const double scale : {1e-290, 1e-90, 1e-79, 1e-61, 1e59, 1e79, 1e90, 1e100, 1e290}) {
    INFO(scale);
    const SurfaceDistance distance =
        measure_distance(scaled(a, scale), scaled(b, scale), {.samples = 200});
    CHECK(distance.rms() / scale == Approx(expected));
    CHECK(distance.diagonal_first / scale == Approx(unscaled.diagonal_first));
    CHECK(distance.diagonal_second / scale == Approx(unscaled.diagonal_second));
  }
  TriangleMesh far = b;
  far.positions.col(0).array() += 1e7;
  CHECK(measure_distance(a, far, {.samples = 2000}).max() == Approx(1e7));
}

TEST_CASE("distance: nothing to measure, no samples, no area, and a word to stop are all told") {
  const TriangleMesh ball = icosphere(1);
  TriangleMesh flat = ball;
  flat.positions.setConstant(2);
  CHECK_THROWS_AS(measure_distance(ball, {}), UnmeasurableSurface);
  CHECK_THROWS_AS(measure_distance(flat, ball), UnmeasurableSurface);
  CHECK_THROWS_AS(measure_distance(ball, flat, {.samples = 9, .faces = false, .edges = true}),
                  UnmeasurableSurface);
  CHECK_THROWS_AS(measure_distance(ball, ball, {.samples = 0}), std::invalid_argument);
  CHECK_THROWS_AS(measure_distance(ball, ball, {.faces = false}), std::invalid_argument);
  TriangleMesh hollow = ball;
  hollow.positions(0, 0) = std::nan("");
  CHECK_THROWS_AS(measure_distance(ball, hollow), UnmeasurableSurface);
  for (const Vertex beyond : {-1, static_cast<int>(ball.vertex_count()), 1 << 30}) {
    TriangleMesh torn = ball;
    torn.triangles(3, 1) = beyond;
    CHECK_THROWS_AS(measure_distance(torn, ball), UnmeasurableSurface);
    CHECK_THROWS_WITH(measure_distance(ball, torn), Catch::Contains("vertex that is not there"));
  }
  const Progress stop = [](std::string_view stage, double) { return stage == "trees"; };
  CHECK_THROWS_AS(measure_distance(ball, ball, {.progress = stop}), Cancelled);
}

TEST_CASE("distance: less than 0 inside of a closed surface, to the bit") {
  const TriangleMesh inner = scaled(cube(), 0.5), outer = cube();
  const DistanceOptions options{.samples = 2000, .deviations = true};
  const SurfaceDistance in = measure_distance(inner, outer, options);
  REQUIRE(in.forth.deviation);
  CHECK(in.forth.deviation->min == -0.5);
  CHECK(in.forth.deviation->max == -0.5);
  CHECK(in.forth.deviation->mean == -0.5);
  CHECK(in.forth.deviation->at_vertices == VectorX::Constant(8, -0.5));
  CHECK_FALSE(in.back.deviation);
  const SurfaceDistance out = measure_distance(outer, inner, options);
  CHECK(out.forth.deviation->max == out.forth.max);
  CHECK(out.forth.deviation->min == out.forth.min);
  CHECK(out.forth.deviation->mean == out.forth.mean);
  CHECK(out.forth.deviation->at_vertices == out.forth.at_vertices);
}

TEST_CASE(
    "distance: a shifted cube is half inside, and the unsigned figures are those without sides") {
  TriangleMesh shifted = cube();
  shifted.positions.col(0).array() += 0.25;
  DistanceOptions options{.samples = 4000, .deviations = true};
  const SurfaceDistance found = measure_distance(shifted, cube(), options);
  const SignedDeviation& deviation = *found.forth.deviation;
  CHECK(deviation.min == -0.25);
  CHECK(deviation.max == 0.25);
  VectorX corners(8);
  for (int v = 0; v < 8; ++v) corners[v] = v % 2 == 0 ? 0 : 0.25;  // the others slide along edges
  CHECK(deviation.at_vertices == corners);
  // Of the six sides: one 1/4 outside, one inside, nearer to the cube's sides along its rim, and
  // strips of four, an eighth wide, that come out to 1/4.
  const double rim = (1 - std::pow(0.75, 3)) / 3, strips = 4 * 0.125 / 8;
  CHECK(deviation.mean == Approx((0.25 - rim + strips) / 6).margin(5e-4));
  options.deviations = false;
  CHECK(same_bits(found, measure_distance(shifted, cube(), options)));
  options.deviations = true;
  options.threads = 3;
  const SignedDeviation again = *measure_distance(shifted, cube(), options).forth.deviation;
  CHECK(again.mean == deviation.mean);
  options.extremes = false;
  const SurfaceDistance samples_alone = measure_distance(shifted, cube(), options);
  CHECK(samples_alone.forth.deviation->mean == deviation.mean);
  CHECK(samples_alone.forth.deviation->at_vertices.size() == 0);
}

TEST_CASE("distance: sides of a surface of any size, and none of one that is open") {
  const DistanceOptions options{.samples = 1000, .deviations = true};
  for (const double size : {1e100, 1e-100}) {
    const SurfaceDistance found =
        measure_distance(scaled(cube(), size / 2), scaled(cube(), size), options);
    CHECK(found.forth.deviation->min == Approx(-size / 2));
    CHECK(found.forth.deviation->at_vertices[3] == Approx(-size / 2));
  }
  const SurfaceDistance itself = measure_distance(icosphere(3), icosphere(3), options);
  CHECK(itself.forth.deviation->min == 0);
  CHECK(measure_distance(plane(3, 0), cube(), options).forth.deviation);
  try {
    measure_distance(cube(), plane(3, 0), options);
    FAIL("a plane has no inside");
  } catch (const UnmeasurableSurface& error) {
    CHECK(error.side() == Side::Second);
    CHECK(std::string(error.what()) ==
          "it is not closed, so nothing is inside: 12 edges are open, or between faces that are "
          "turned against each other");
  }
}

}  // namespace sphparam
