#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sphparam/bake/bake.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr int width = 64;

/// A ball without its top, of stripes that are red or blue.
MeshFile bowl() {
  MeshFile file;
  file.mesh = icosphere(4);
  file.mesh.positions *= 0.99;
  std::vector<Eigen::Index> kept;
  for (Face f = 0; f < file.mesh.face_count(); ++f)
    if (file.mesh.position(file.mesh.triangles(f, 0)).z() < 0.6) kept.push_back(f);
  file.mesh.triangles = Triangles(file.mesh.triangles(kept, Eigen::all));
  Property red{"red", ScalarType::Float32, {}}, green = red, blue = red;
  green.name = "green", blue.name = "blue";
  for (const auto& p : file.mesh.positions.rowwise()) {
    const bool is_red = std::sin(8 * std::atan2(p[1], p[0])) > 0;
    red.values.push_back(is_red);
    green.values.push_back(0);
    blue.values.push_back(!is_red);
  }
  for (const Property& colour : {red, green, blue}) file.set_vertex_property(colour);
  return file;
}

/// Three linear numbers a texel, of the bowl on a ball that closes it.
std::vector<float> baked(const std::string& field, double calm_beyond, int threads = 1,
                         const MeshFile& surface = bowl()) {
  MeshFile ball;
  ball.mesh = icosphere(3);
  SphereMap map{ball.mesh.positions};
  const MappedMesh mapped({.file = std::move(ball), .map = std::move(map)});
  BakeSettings settings{
      .width = width, .from = surface, .calm_beyond = calm_beyond, .threads = threads};
  std::vector<float> values;
  bake_values(mapped, {field}, settings,
              [&](size_t, const BakedField&, int, int rows, const float* row) {
                values.insert(values.end(), row, row + 3 * rows * width);
              });
  return values;
}

/// How far the reds of some rows are apart.
float spread_of_red(const std::vector<float>& values, int first_row, int rows) {
  float least = 1, most = 0;
  for (int i = first_row * width; i < (first_row + rows) * width; ++i) {
    least = std::min(least, values[static_cast<size_t>(3 * i)]);
    most = std::max(most, values[static_cast<size_t>(3 * i)]);
  }
  return most - least;
}

}  // namespace

TEST_CASE("calm walls: a wall shows a smooth mean of what stands about it, all else is as it was") {
  const std::vector<float> streaks = baked("vcolor", 0), calm = baked("vcolor", 0.1);
  CHECK(spread_of_red(streaks, 0, 4) > 0.9);
  CHECK(spread_of_red(calm, 0, 4) < 0.2);
  CHECK(spread_of_red(calm, 0, 1) < 0.02);
  CHECK(calm[0] == Approx(0.5).margin(0.05));
  CHECK(calm[1] == 0);
  // The rim is at 53°: below it nothing changes.
  const auto below = static_cast<std::ptrdiff_t>(3 * width * (width / 2) * 56 / 180);
  CHECK(std::equal(calm.begin() + below, calm.end(), streaks.begin() + below));
}

TEST_CASE("calm walls: clear ones are masked out of the base colour, and out of nothing else") {
  MeshFile ball;
  ball.mesh = icosphere(3);
  SphereMap map{ball.mesh.positions};
  const MappedMesh mapped({.file = std::move(ball), .map = std::move(map)});
  BakeSettings settings{
      .width = width, .from = bowl(), .calm_beyond = 0.1, .clear_walls = true, .threads = 1};
  std::array<std::vector<float>, 2> values;
  bake_values(mapped, {"basecolor", "vcolor"}, settings,
              [&](size_t field, const BakedField& baked, int, int rows, const float* row) {
                REQUIRE(baked.channels == (field == 0 ? 4 : 3));
                values[field].insert(values[field].end(), row, row + baked.channels * rows * width);
              });
  const std::vector<float>&colour = values[0], &plain = values[1];
  CHECK(plain == baked("vcolor", 0.1));
  int clear = 0;
  for (size_t i = 0; i < plain.size() / 3; ++i) {
    const float alpha = colour[4 * i + 3];  // a texel may be of several samples
    const bool is_wall = alpha < 0.5;
    clear += is_wall;
    for (size_t c = 0; c < 3; ++c) CHECK(colour[4 * i + c] == plain[3 * i + c]);
    // The rim is at 53°, 0.1 of the radius within it 47°.
    const auto row = static_cast<int>(i) / width;
    if (row < width / 2 * 42 / 180) CHECK(alpha == 0);
    if (row > width / 2 * 56 / 180) CHECK(alpha == Approx(1).margin(1e-6));
  }
  CHECK(clear > width * 7);
}

TEST_CASE("calm walls: what is masked out shows what lies close behind it, not what is far") {
  // A green ball in one that is masked out, on a ball about both.
  MeshFile file;
  const TriangleMesh ball = icosphere(3);
  const Eigen::Index n = ball.vertex_count(), faces = ball.face_count();
  file.mesh = {Points(2 * n, 3), Triangles(2 * faces, 3)};
  file.mesh.positions << 0.98 * ball.positions, 0.9 * ball.positions;
  file.mesh.triangles << ball.triangles, (ball.triangles.array() + static_cast<int>(n)).matrix();
  file.materials = {"leaves", "wall"};
  file.base_colours = {{.factor = {1, 0, 0, 0.25}}, {.factor = {0, 1, 0, 1}}};
  file.channels.resize(2);
  file.channels[0].alpha_mode = AlphaMode::Mask;
  Property material{"material", ScalarType::Int32,
                    std::vector<double>(static_cast<size_t>(2 * faces), 1)};
  std::fill_n(material.values.begin(), faces, 0);
  file.set_face_property(material);
  MeshFile about;
  about.mesh = ball;
  const MappedMesh mapped({.file = std::move(about), .map = SphereMap{ball.positions}});
  const auto first = [&](double calm_beyond) {
    std::vector<float> texel;
    bake_values(mapped, {"basecolor"},
                {.width = 16, .from = file, .calm_beyond = calm_beyond, .threads = 1},
                [&](size_t, const BakedField& field, int row, int, const float* values) {
                  CHECK(field.channels == 4);
                  if (row == 0) texel.assign(values, values + 4);
                });
    return texel;
  };
  const auto is = [](const std::vector<float>& texel, std::array<float, 4> expected) {
    for (size_t c = 0; c < 4; ++c) CHECK(texel.at(c) == Approx(expected[c]).margin(1e-5));
  };
  is(first(0.1), {0, 1, 0, 1});
  is(first(0.03), {1, 0, 0, 0.25F});
  is(first(0), {1, 0, 0, 0.25F});
}

TEST_CASE("calm walls: of what stands about a wall, what is near counts most") {
  MeshFile halves = bowl();
  for (size_t v = 0; v < halves.vertex_properties[0].values.size(); ++v) {
    const bool is_red = halves.mesh.positions(static_cast<Eigen::Index>(v), 1) > 0;
    halves.vertex_properties[0].values[v] = is_red;
    halves.vertex_properties[2].values[v] = !is_red;
  }
  const std::vector<float> calm = baked("vcolor", 0.1, 1, halves);
  const auto red = [&](int column) { return calm[static_cast<size_t>(3 * (3 * width + column))]; };
  CHECK(red(width / 4) > 0.55);  // towards +y
  CHECK(red(3 * width / 4) < 0.45);
  CHECK(red(width / 4) + red(3 * width / 4) == Approx(1).margin(0.02));
}

TEST_CASE("calm walls: what does not stand beside a wall does not count") {
  MeshFile banded = bowl();  // green at its rim, red below
  for (size_t v = 0; v < banded.vertex_properties[0].values.size(); ++v) {
    const bool is_green = banded.mesh.positions(static_cast<Eigen::Index>(v), 2) > 0.1;
    banded.vertex_properties[0].values[v] = !is_green;
    banded.vertex_properties[1].values[v] = is_green;
    banded.vertex_properties[2].values[v] = 0;
  }
  const std::vector<float> calm = baked("vcolor", 0.1, 1, banded);
  CHECK(calm[0] < 0.05);
  CHECK(calm[1] > 0.95);
}

TEST_CASE("calm walls: tangent normals stand on a wall") {
  const std::vector<float> streaks = baked("normal-tangent", 0),
                           calm = baked("normal-tangent", 0.1);
  CHECK(streaks[3 * width * 4 + 1] < -0.3F);
  for (size_t i = 0; i < 3 * width * 6; i += 3) {
    CHECK(calm[i] == Approx(0).margin(0.1));
    CHECK(calm[i + 1] == Approx(0).margin(0.1));
    CHECK(calm[i + 2] > 0.99);
  }
}

TEST_CASE("calm walls: the same for any number of threads, places stay as they are found") {
  CHECK(baked("vcolor", 0.1, 1) == baked("vcolor", 0.1, 3));
  CHECK(baked("position", 0.1) == baked("position", 0));
  CHECK(baked("vcolor", 10) == baked("vcolor", 0));  // nothing is so far
}
