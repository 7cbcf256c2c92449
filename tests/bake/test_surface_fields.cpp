#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "bake/field_registry.h"
#include "bake/fields/curvature_field.h"
#include "bake/fields/distortion_fields.h"
#include "bake/fields/heat_field.h"
#include "bake/fields/height_field.h"
#include "support/test_meshes.h"

namespace sphparam {

namespace {

using namespace sphparam::tests;

constexpr double pi = std::numbers::pi;

/// The mesh mapped to the sphere from the origin, baked for itself. Requires: star-shaped.
BakeScene scene_of(const TriangleMesh& mesh, const TriangleMesh* target = nullptr) {
  MeshFile file;
  file.mesh = mesh;
  const SphereMap map = normalised(mesh.positions);
  const TriangleMesh& base = target ? *target : mesh;
  SphericalChart chart = spherical_chart(base, Topology(base), normalised(base.positions));
  Points positions(chart.points.rows(), 3);
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const SurfacePoint& point = chart.surface_points[static_cast<size_t>(v)];
    Vector3 at = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      at += point.barycentric[k] * base.position(base.triangles(point.face, k));
    }
    positions.row(v) = at;
  }
  const Points normals = chart.points;
  return {.source = {.mapped = MappedMesh({.file = file, .map = map}),
                     .normals = map.points,
                     .textures = {}},
          .target = {.chart = std::move(chart),
                     .positions = std::move(positions),
                     .normals = normals,
                     .is_source = target == nullptr},
          .options = {},
          .threads = 0};
}

/// Values at the middles of the source's faces.
std::vector<float> at_middles(const SurfaceField& field, const BakeScene& scene) {
  const Eigen::Index faces = scene.source.mesh().face_count();
  std::vector<float> values(static_cast<size_t>(faces * field.channels));
  std::vector<SurfaceSample> samples;
  std::vector<SurfaceRun> runs;
  for (Face f = 0; f < faces; ++f) {
    const Vector3 middle = Vector3::Constant(1.0 / 3);
    samples.push_back({.point = {f, middle}, .seed = 0});
    runs.push_back({f, 1, middle, Vector3::Zero(), Vector3::Zero()});
  }
  if (field.evaluate_runs) {
    field.evaluate_runs(runs, values.data());
  } else {
    field.evaluate(samples, values.data());
  }
  return values;
}

TriangleMesh ellipsoid(int level, double x, double y, double z) {
  TriangleMesh mesh = icosphere(level);
  mesh.positions.col(0) *= x;
  mesh.positions.col(1) *= y;
  mesh.positions.col(2) *= z;
  return mesh;
}

}  // namespace

TEST_CASE("area field: areas times ratios add up to the sphere") {
  const BakeScene scene = scene_of(ellipsoid(3, 1, 2, 0.4));
  const std::vector<float> log2 = at_middles(area_field(scene, ""), scene);
  const TriangleMesh& mesh = scene.source.mesh();
  double total = 0, mapped = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Vector3 a = mesh.position(mesh.triangles(f, 0));
    const double area = (mesh.position(mesh.triangles(f, 1)) - a)
                            .cross(mesh.position(mesh.triangles(f, 2)) - a)
                            .norm() /
                        2;
    total += area;
    mapped += area * std::exp2(static_cast<double>(log2[static_cast<size_t>(f)]));
  }
  CHECK(mapped == Approx(total).epsilon(1e-5));
}

TEST_CASE("distortion fields: a sphere of any size has none, a squashed one has all three") {
  for (auto* make : {area_field, angle_field, stretch_field}) {
    TriangleMesh ball = icosphere(3);
    ball.positions *= 12;
    const BakeScene round = scene_of(ball), flat = scene_of(ellipsoid(3, 1, 1, 0.2));
    const SurfaceField field = make(round, "");
    INFO(field.name);
    REQUIRE(field.range);
    CHECK(field.range->second == 3);
    for (const float value : at_middles(field, round)) CHECK(std::abs(value) < 0.05F);
    float most = 0;
    for (const float value : at_middles(make(flat, ""), flat)) {
      most = std::max(most, std::abs(value));
      CHECK(std::isfinite(value));
    }
    CHECK(most > 0.5F);
  }
}

TEST_CASE("stretch field: where the sphere is smaller than the mesh, the image is stretched") {
  const BakeScene scene = scene_of(ellipsoid(4, 1, 1, 4));
  const TriangleMesh& mesh = scene.source.mesh();
  const std::vector<float> stretch = at_middles(stretch_field(scene, ""), scene);
  const std::vector<float> area = at_middles(area_field(scene, ""), scene);
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const double z = mesh.positions(mesh.triangles(f, 0), 2);
    if (std::abs(z) < 3.5 && std::abs(z) > 0.3) continue;
    // Seen from the origin the tips are far away: shrunk; the waist is near.
    const bool tip = std::abs(z) > 3.5;
    CHECK((area[static_cast<size_t>(f)] < 0) == tip);
    if (tip) CHECK(stretch[static_cast<size_t>(f)] > 0);
  }
}

TEST_CASE("curvature field: 1/r and 1/r^2 on a sphere of radius r, whatever its mesh") {
  for (const int level : {3, 5}) {
    TriangleMesh ball = icosphere(level);
    ball.positions *= 2;
    const BakeScene scene = scene_of(ball);
    for (const float value : at_middles(curvature_field(scene, ""), scene)) {
      CHECK(value == Approx(0.5).epsilon(0.12));
    }
    for (const float value : at_middles(curvature_field(scene, "gauss"), scene)) {
      CHECK(value == Approx(0.25).epsilon(0.12));
    }
  }
}

TEST_CASE(
    "curvature field: the range is symmetric, holds 98 % of the area, and the scale is told") {
  const BakeScene scene = scene_of(ellipsoid(4, 1, 1.5, 3));
  const SurfaceField field = curvature_field(scene, "mean");
  REQUIRE(field.range);
  CHECK(field.range->first == -field.range->second);
  long beyond = 0;
  const std::vector<float> values = at_middles(field, scene);
  for (const float value : values) {
    beyond += std::abs(static_cast<double>(value)) > field.range->second;
  }
  CHECK(beyond > 0);
  CHECK(beyond < static_cast<long>(values.size()) / 20);
  CHECK_THAT(field.about, Catch::Contains("averaged over"));
  BakeScene coloured = scene_of(ellipsoid(4, 1, 1.5, 3));  // convex: nothing is below −high
  coloured.options.heat = true;
  const SurfaceField heat = curvature_field(coloured, "mean");
  CHECK(heat.scale->above);
  CHECK_FALSE(heat.scale->below);
  CHECK_THROWS_AS(curvature_field(scene, "median"), FieldError);
}

TEST_CASE("height field: distance from the origin, above another mesh, along its normals") {
  TriangleMesh ball = icosphere(4), base = icosphere(3);
  ball.positions *= 1.25;
  const BakeScene scene = scene_of(ball);
  const SurfaceField radial = height_field(scene, "");
  for (const float value : at_middles(radial, scene)) CHECK(value == Approx(1.25).epsilon(5e-3));

  const BakeScene above = scene_of(ball, &base);
  const SurfaceField height = height_field(above, "");
  const SphericalChart& chart = above.target.chart;
  for (Vertex v = 0; v < base.vertex_count(); v += 7) {
    // The vertices of the base are vertices of the ball, by the order of subdivision.
    SurfaceSample sample;
    for (Face f = 0; f < ball.face_count(); ++f) {
      for (int k = 0; k < 3; ++k) {
        if (ball.triangles(f, k) == v) sample.point = {f, Vector3::Unit(k)};
      }
    }
    for (Face f = 0; f < chart.triangles.rows(); ++f) {
      for (int k = 0; k < 3; ++k) {
        if (chart.triangles(f, k) == v) sample.place = {f, Vector3::Unit(k)};
      }
    }
    const Vector3 direction = chart.points.row(v);
    REQUIRE((ball.position(v).normalized() - direction).norm() < 1e-9);
    float value = 0;
    height.evaluate({&sample, 1}, &value);
    CHECK(value == Approx(0.25).margin(1e-6));
  }
  for (const float value : at_middles(height_field(above, "radial"), above)) CHECK(value > 1.2F);
  CHECK_THROWS_AS(height_field(scene, "upwards"), FieldError);
}

TEST_CASE("height field: above a mesh with hard edges, along the normals of its wedges") {
  TriangleMesh ball = icosphere(1), base = icosphere(1);
  BakeScene scene = scene_of(ball, &base);
  SphericalChart& chart = scene.target.chart;
  // Every wedge its own; all of them look up.
  chart.wedges.resize(chart.triangles.rows(), 3);
  for (Face f = 0; f < chart.wedges.rows(); ++f) chart.wedges.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  scene.target.wedge_normals = Vector3::UnitZ().transpose().replicate(3 * chart.wedges.rows(), 1);
  const SurfaceSample sample = {
      .point = {0, Vector3::UnitX()}, .seed = 0, .place = {0, Vector3::UnitY()}};
  float value = 0;
  height_field(scene, "").evaluate({&sample, 1}, &value);
  const double from = scene.target.positions(chart.triangles(0, 1), 2);
  CHECK(value == Approx(ball.positions(ball.triangles(0, 0), 2) - from).margin(1e-6));
}

TEST_CASE("as_heat: the colours of the scale, with the same range and a legend of it") {
  BakeScene scene = scene_of(ellipsoid(3, 1, 1, 0.3));
  const std::vector<float> numbers = at_middles(area_field(scene, ""), scene);
  scene.options.heat = true;
  const SurfaceField field = area_field(scene, "");
  CHECK(field.kind == FieldKind::Colour);
  REQUIRE(field.channels == 3);
  const std::vector<float> colours = at_middles(field, scene);
  for (size_t f = 0; f < numbers.size(); ++f) {
    const Rgb expected = to_linear(diverging(static_cast<double>(numbers[f]) / 3));
    CHECK((expected - Rgb(&colours[3 * f])).norm() < 1e-5F);
  }
  CHECK(field.scale->title == "area ratio");
  CHECK(curvature_field(scene, "").scale->title == "curvature mean");
  CHECK_FALSE((field.scale->below || field.scale->above));
  CHECK_FALSE(height_field(scene, "").scale);
  CHECK_THROWS_AS(as_heat(field), std::invalid_argument);
}

}  // namespace sphparam
