#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "charted.h"
#include "gltf/compact_order.h"
#include "gltf/written_check.h"
#include "io/formats/gltf/gltf_reader.h"
#include "sphparam/gltf/gltf_writer.h"
#include "support/glb_json.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Whatever a corner has, in a row.
using Corner = std::vector<float>;

Corner corner(const Surface& surface, std::uint32_t index) {
  Corner numbers;
  const auto add = [&](const FloatRows& rows) {
    for (Eigen::Index k = 0; k < rows.cols() && rows.rows() > 0; ++k)
      numbers.push_back(rows(index, k));
  };
  add(surface.positions);
  add(surface.normals);
  add(surface.tangents);
  for (const FloatRows& texcoords : surface.texcoords) add(texcoords);
  for (const CustomAttribute& custom : surface.custom) add(custom.values);
  for (const MorphTarget& target : surface.targets) add(target.positions);
  if (!surface.colours.empty()) numbers.push_back(surface.colours[index][0]);
  return numbers;
}

/// The triangles, each from its least corner on.
std::multiset<std::array<Corner, 3>> triangles(const Surface& surface) {
  std::multiset<std::array<Corner, 3>> all;
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    std::array<Corner, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = corner(surface, surface.indices[i + k]);
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    all.insert(triangle);
  }
  return all;
}

/// The egg with its vertices in no order, a colour each, and one that no triangle has.
Asset shuffled_egg() {
  Asset asset = Charted({}, 3).asset(
      {.morph = Morph::Sphere, .buffers = {.tangents = true, .theta_phi = true}});
  Surface& surface = asset.levels[0];
  std::vector<std::uint32_t> place(surface.vertex_count());
  std::iota(place.begin(), place.end(), 0U);
  std::ranges::shuffle(place, std::mt19937(7));
  const auto moved = [&](FloatRows& rows) {
    const FloatRows before = rows;
    for (Eigen::Index i = 0; i < before.rows(); ++i)
      rows.row(place[static_cast<std::size_t>(i)]) = before.row(i);
    rows.conservativeResize(before.rows() + 1, before.cols());
    rows.row(before.rows()) = before.row(0);
  };
  for (FloatRows* rows : {&surface.positions, &surface.normals, &surface.tangents}) moved(*rows);
  for (FloatRows& rows : surface.texcoords) moved(rows);
  for (CustomAttribute& custom : surface.custom) moved(custom.values);
  for (MorphTarget& target : surface.targets) {
    for (FloatRows* rows : {&target.positions, &target.normals, &target.tangents}) moved(*rows);
  }
  for (std::uint32_t& index : surface.indices) index = place[index];
  for (std::size_t i = 0; i < surface.vertex_count(); ++i)
    surface.colours.push_back({static_cast<std::uint16_t>(i), 0, 0, 65535});
  return asset;
}

/// Degrees between normals as read from a file and those of a surface.
double most_off(const MeshFile& file, const Surface& surface) {
  double least = 1;
  for (Eigen::Index i = 0; i < surface.normals.rows(); ++i) {
    Vector3 read;
    int axis = 0;
    for (const char* name : {"nx", "ny", "nz"})
      read[axis++] = file.find_vertex_property(name)->values[static_cast<std::size_t>(i)];
    const Vector3 meant = surface.normals.row(i).cast<double>();
    least = std::min(least, read.normalized().dot(meant.normalized()));
  }
  return std::acos(std::min(least, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("compact_order: the same triangles with all that their corners have, and no others") {
  const Asset egg = shuffled_egg();
  const Asset ordered = in_compact_order(egg);
  CHECK(ordered.levels[0].vertex_count() == egg.levels[0].vertex_count() - 1);
  CHECK(triangles(ordered.levels[0]) == triangles(egg.levels[0]));
}

TEST_CASE("compact_order: vertices come in the order of first use") {
  const Asset ordered = in_compact_order(shuffled_egg());
  std::uint32_t next = 0;
  for (const std::uint32_t index : ordered.levels[0].indices) {
    REQUIRE(index <= next);
    next += index == next;
  }
  CHECK(next == ordered.levels[0].vertex_count());
}

TEST_CASE("compact_order: what is compressed in it takes a third less at least") {
  Asset egg = shuffled_egg();
  egg.levels[0].targets.clear();  // float32, whose bytes no order helps
  egg.levels[0].custom.clear();
  egg.levels[0].colours.clear();  // noise here
  const GltfOptions options{.quantise = true, .compress = true};
  const std::string before = glb_bytes(egg, options),
                    after = glb_bytes(in_compact_order(egg), options);
  CHECK(3 * json_of(after)["buffers"][0]["byteLength"].get<int>() <
        2 * json_of(before)["buffers"][0]["byteLength"].get<int>());
}

TEST_CASE("compression: no normal is off by 1 degree, wherever it points") {
  Asset egg = in_compact_order(Charted({}, 5).asset({.buffers = {.uv = {.sixteen_bits = true}}}));
  Surface& surface = egg.levels[0];
  surface.targets.clear();
  std::mt19937 random(3);
  std::normal_distribution<float> number;
  for (auto normal : surface.normals.rowwise()) {
    normal << number(random), number(random), number(random);
    normal.normalize();
  }
  const std::string glb = glb_bytes(egg, {.quantise = true, .compress = true});
  CHECK(most_off(read_gltf(glb, "egg.glb", std::nullopt, {}), surface) < 0.8);
}

TEST_CASE("compression: quantised normals are read back to 1 degree, tangents keep their sign") {
  const Asset egg = in_compact_order(
      Charted({}, 4).asset({.buffers = {.uv = {.sixteen_bits = true}, .tangents = true}}));
  const GltfOptions options{.quantise = true, .compress = true};
  const std::string glb = glb_bytes(egg, options);
  check_written(glb, "egg.glb", egg, options);
  const MeshFile file = read_gltf(glb, "egg.glb", std::nullopt, {});
  const double degrees = most_off(file, egg.levels[0]);
  CHECK(degrees > 0);
  CHECK(degrees < 1);
  int filtered = 0;
  const auto gltf = json_of(glb);
  for (const auto& view : gltf["bufferViews"]) {
    const auto& compressed = view["extensions"]["EXT_meshopt_compression"];
    filtered += compressed.value("filter", "") == "OCTAHEDRAL";
  }
  CHECK(filtered == 2);
}
