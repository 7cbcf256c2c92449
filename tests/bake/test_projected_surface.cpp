#include <catch2/catch.hpp>
#include <numbers>

#include "bake/connected_faces.h"
#include "bake/field_registry.h"
#include "bake/projected_surface.h"
#include "scenes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

const BakeOptions small = {.width = 64, .height = 32};

TriangleMesh scaled(TriangleMesh mesh, double size) {
  mesh.positions *= size;
  return mesh;
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

MeshFile file_of(TriangleMesh mesh) {
  MeshFile file;
  file.mesh = std::move(mesh);
  return file;
}

MeshFile both(TriangleMesh a, const TriangleMesh& b) {
  const Eigen::Index vertices = a.positions.rows(), faces = a.triangles.rows();
  a.positions.conservativeResize(vertices + b.positions.rows(), 3);
  a.positions.bottomRows(b.positions.rows()) = b.positions;
  a.triangles.conservativeResize(faces + b.triangles.rows(), 3);
  a.triangles.bottomRows(b.triangles.rows()) = b.triangles.array() + static_cast<int>(vertices);
  return file_of(std::move(a));
}

/// A surface baked on the unit sphere, whose map it is.
std::unique_ptr<BakeScene> on_sphere(MeshFile surface, const TriangleMesh& mesh = icosphere(3)) {
  const MappedMesh mapped({.file = file_of(mesh), .map = normalised(mesh.positions)}, 1);
  return std::unique_ptr<BakeScene>(new BakeScene{
      make_source(std::move(surface)), make_target(mapped, false, 1), FieldOptions{}, 1});
}

std::vector<float> baked(const BakeScene& scene, const std::string& field) {
  return tests::baked(scene, make_field(field, scene), small);
}

/// visit(direction of the texel's centre, its value).
template <class Visit>
void for_each_texel(const std::vector<float>& values, const Visit& visit) {
  for (int y = 0, i = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x, i += 3) {
      const double theta = 2 * std::numbers::pi * (x + 0.5) / small.width,
                   phi = std::numbers::pi * (y + 0.5) / small.height;
      visit(to_cartesian({theta, phi}),
            Vector3(values[static_cast<size_t>(i)], values[static_cast<size_t>(i) + 1],
                    values[static_cast<size_t>(i) + 2]));
    }
}

ProjectionShares shares_of(const BakeScene& scene) {
  return measure_projection(*scene.source.surface, scene.target, 1);
}

}  // namespace

TEST_CASE("projected surface: of itself a mesh shows every point") {
  const TriangleMesh mesh = icosphere(3);
  const auto scene = on_sphere(file_of(mesh), mesh);
  const auto own = sphere_scene(mesh);
  const auto here = tests::baked(*own, make_field("position", *own), small);
  const auto there = baked(*scene, "position");
  REQUIRE(here.size() == there.size());
  for (size_t i = 0; i < here.size(); ++i) CHECK(there[i] == Approx(here[i]).margin(2e-6));
  const ProjectionShares shares = shares_of(*scene);
  CHECK(shares.back == 0);
  CHECK(shares.nearest == 0);
  CHECK(shares.farthest < 1e-12);
}

TEST_CASE("projected surface: spheres within and without show the point in the same direction") {
  for (const double size : {0.8, 1.3}) {
    const auto scene = on_sphere(file_of(scaled(icosphere(4), size)));
    for_each_texel(baked(*scene, "position"), [&](const Vector3& direction, const Vector3& value) {
      CHECK(value.norm() == Approx(size).epsilon(2e-3));
      CHECK(value.normalized().dot(direction) > 1 - 3e-4);
    });
    const ProjectionShares shares = shares_of(*scene);
    CHECK(shares.nearest == 0);
    CHECK(shares.median == Approx(std::abs(size - 1) / (2 * std::sqrt(3.0) * size)).epsilon(0.02));
    for (const float height : baked(*scene, "height"))
      CHECK(height == Approx(size - 1).margin(6e-3));
  }
}

TEST_CASE("projected surface: it is sought outwards, whatever normals the target is lit with") {
  MeshFile lit = file_of(icosphere(3));
  for (const char* name : {"nx", "ny", "nz"}) {
    const double all = name[1] == 'x' ? 1 : 0;
    lit.vertex_properties.push_back(
        {name, ScalarType::Float64,
         std::vector<double>(static_cast<size_t>(lit.mesh.vertex_count()), all)});
  }
  const MappedMesh mapped({.file = lit, .map = normalised(lit.mesh.positions)}, 1);
  const BakeScene scene{make_source(file_of(scaled(icosphere(4), 0.8))),
                        make_target(mapped, false, 1), FieldOptions{}, 1};
  for_each_texel(baked(scene, "position"), [&](const Vector3& direction, const Vector3& value) {
    CHECK(value.normalized().dot(direction) > 1 - 3e-4);
  });
}

TEST_CASE("projected surface: of two layers the nearer that faces the same way is shown") {
  const auto scene =
      on_sphere(both(turned_inside_out(scaled(icosphere(3), 1.02)), scaled(icosphere(3), 0.95)));
  for (const float height : baked(*scene, "height")) CHECK(height == Approx(-0.05).margin(5e-3));
  CHECK(shares_of(*scene).back == 0);
}

TEST_CASE("projected surface: its parts, which hang together by places, are told apart") {
  const auto scene =
      on_sphere(both(turned_inside_out(scaled(icosphere(3), 1.02)), scaled(icosphere(3), 0.95)));
  for (const float part : baked(*scene, "id:component")) CHECK(part == 1);
  TriangleMesh apart = both(icosphere(1), scaled(icosphere(0), 0.5)).mesh;  // 80 and 20 triangles
  Points corners(3 * apart.face_count(), 3);
  for (Face f = 0; f < apart.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      corners.row(3 * f + k) = apart.positions.row(apart.triangles(f, k));
      apart.triangles(f, k) = 3 * f + k;
    }
  apart.positions = corners;
  std::vector<int> expected(80, 0);
  expected.resize(100, 1);
  CHECK(parts_of_faces(apart) == expected);
}

TEST_CASE("projected surface: what is seen from behind is told, its normals turned round") {
  const auto scene = on_sphere(file_of(turned_inside_out(scaled(icosphere(3), 0.9))));
  for_each_texel(
      baked(*scene, "normal-object"),
      [](const Vector3& direction, const Vector3& value) { CHECK(value.dot(direction) > 0.99); });
  CHECK(shares_of(*scene).back == Approx(1));
  for (const float how : baked(*scene, "found")) CHECK(how == 1);
  for (const float sky : baked(*scene, "ao")) CHECK(sky == Approx(1).margin(1e-5));
}

TEST_CASE("projected surface: shares are of area, wherever both lie") {
  // Half of the sphere, of few large triangles beside many small ones.
  TriangleMesh mesh = icosphere(3), half = scaled(icosphere(3), 0.9);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < half.triangles.rows(); ++f)
    if (half.positions(half.triangles(f, 0), 2) > 0) kept.push_back(f);
  half.triangles = Triangles(half.triangles(kept, Eigen::all));
  for (TriangleMesh* m : {&mesh, &half}) m->positions.col(2).array() += 0.4;
  const auto shares = [&](const Vector3& moved) {
    TriangleMesh a = mesh, b = half;
    for (TriangleMesh* m : {&a, &b}) m->positions.rowwise() += moved.transpose();
    MeshFile file = file_of(a);
    const MappedMesh mapped({.file = file, .map = normalised(mesh.positions)}, 1);
    const BakeScene scene{make_source(file_of(b)), make_target(mapped, false, 1), FieldOptions{},
                          1};
    return shares_of(scene);
  };
  const ProjectionShares here = shares(Vector3::Zero()), there = shares(Vector3(3, -5, 2));
  CHECK(here.nearest + here.back > 0.3);
  CHECK(there.nearest == Approx(here.nearest).margin(0.01));
  CHECK(there.back == Approx(here.back).margin(0.01));
  CHECK(there.median == Approx(here.median).margin(1e-3));
}

TEST_CASE("projected surface: beyond its rim the nearest point is shown, and told") {
  // What is left of a sphere: a cap about +x, of 60°.
  TriangleMesh cap = scaled(icosphere(4), 0.9);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < cap.triangles.rows(); ++f)
    if (cap.positions(cap.triangles(f, 0), 0) > 0.45) kept.push_back(f);
  cap.triangles = Triangles(cap.triangles(kept, Eigen::all));
  const auto scene = on_sphere(file_of(cap));
  const ProjectionShares shares = shares_of(*scene);
  CHECK(shares.nearest > 0.4);
  CHECK(shares.nearest + shares.back == Approx(0.75).margin(0.05));  // of the sphere beyond 60°
  const auto found = baked(*scene, "found");
  const auto position = baked(*scene, "position");
  CHECK(found[static_cast<size_t>(small.width * small.height / 2)] == 0);  // +x
  CHECK(found[static_cast<size_t>(small.width * small.height / 2 + small.width / 2)] ==
        1);  // −x: its inside
  for (size_t i = 0; i < position.size(); i += 3) CHECK(position[i] > 0.37F);
}

TEST_CASE("projected surface: what is far beyond the nearest point is not met") {
  // The far sphere faces the right way, but the near one is what is here.
  const auto scene =
      on_sphere(both(turned_inside_out(scaled(icosphere(3), 0.9)), scaled(icosphere(3), 1.6)));
  for (const float how : baked(*scene, "found")) CHECK(how == 1);
}

TEST_CASE("projected surface: colours are averaged over what a texel covers of it") {
  // Vertices in turn black and white, far finer than the texels: grey everywhere.
  MeshFile fine = file_of(scaled(icosphere(6), 1.01));
  for (const char* name : {"red", "green", "blue"}) {
    Property property{.name = name, .type = ScalarType::Uint8, .values = {}};
    for (Vertex v = 0; v < fine.mesh.vertex_count(); ++v)
      property.values.push_back(v % 2 == 0 ? 0 : 255);
    fine.set_vertex_property(property);
  }
  const auto scene = on_sphere(std::move(fine));
  double sum = 0, squares = 0;
  const std::vector<float> grey = baked(*scene, "vcolor");
  for (const float value : grey) {
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(grey.size());
  CHECK(sum / count == Approx(0.5).margin(0.02));  // linear light
  CHECK(squares / count - sum * sum / count / count < 0.02);
}

TEST_CASE("projected surface: triangles may be far finer one way than the other") {
  const bool to_the_east = GENERATE(true, false);
  // Stripes that are about five to a texel, in turn black and white.
  constexpr int stripes = 300, few = 9;
  MeshFile fine = file_of(
      scaled(to_the_east ? uv_sphere(stripes, few) : uv_sphere(few, stripes / 2 - 1), 1.01));
  Property stripe{.name = "red", .type = ScalarType::Uint8, .values = {}};
  for (const auto& p : fine.mesh.positions.rowwise()) {
    const SphericalCoordinates angles = to_spherical(p.normalized());
    const double turn = to_the_east ? angles.theta : angles.phi;
    const long number = std::lround(turn / (2 * std::numbers::pi) * stripes);
    stripe.values.push_back(number % 2 == 0 ? 0 : 255);
  }
  for (const char* name : {"red", "green", "blue"}) {
    stripe.name = name;
    fine.set_vertex_property(stripe);
  }
  const auto scene = on_sphere(std::move(fine));
  int apart = 0, all = 0;
  for_each_texel(baked(*scene, "vcolor"), [&](const Vector3& direction, const Vector3& colour) {
    if (std::abs(direction.z()) > 0.7) return;
    ++all;
    apart += std::abs(colour.x() - 0.5) > 0.15;  // a point of a stripe is 0.25 away in the mean
  });
  CHECK(all > 900);
  CHECK(apart < all / 50);
}

TEST_CASE("projected surface: what a map would have to tell is refused, and no surface too") {
  const auto scene = on_sphere(file_of(icosphere(2)));
  for (const char* field : {"area", "angle", "stretch", "curvature"})
    CHECK_THROWS_AS(make_field(field, *scene), FieldError);
  const auto own = sphere_scene(icosphere(2));
  CHECK_THROWS_AS(make_field("found", *own), FieldError);
  CHECK_THROWS_AS(make_source(MeshFile{}), FieldError);
}
