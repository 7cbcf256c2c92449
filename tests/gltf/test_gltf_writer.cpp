#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>
#include <tuple>
#include <vector>

#include "charted.h"
#include "gltf/format/packing.h"
#include "gltf/images/material_images.h"
#include "gltf/images/variant_images.h"
#include "gltf/shape.h"
#include "gltf/written_check.h"
#include "io/uri.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/io/mesh_reader.h"
#include "support/glb_json.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;
using nlohmann::json;

namespace {

/// A row of so many vertices, and one triangle that uses the last.
Asset long_asset(Eigen::Index vertices) {
  Surface surface;
  surface.positions = FloatRows::Zero(vertices, 3);
  surface.positions.col(0).setLinSpaced(0, 1);
  surface.normals = FloatRows::Zero(vertices, 3);
  surface.normals.col(2).setOnes();
  surface.texcoords = {FloatRows::Zero(vertices, 2)};
  surface.indices = {0, 1, static_cast<std::uint32_t>(vertices - 1)};
  return {
      .name = "row", .levels = {surface}, .images = {}, .materials = {{.name = "m"}}, .extras = {}};
}

int index_type(Eigen::Index vertices) {
  const json gltf = json_of(glb_bytes(long_asset(vertices)));
  const int accessor = gltf["meshes"][0]["primitives"][0]["indices"];
  return gltf["accessors"][accessor]["componentType"];
}

}  // namespace

TEST_CASE("gltf_writer: what is written is what is read, in every container and encoding") {
  const Charted egg;
  const Asset asset =
      egg.asset({.morph = Morph::Flat, .buffers = {.tangents = true, .theta_phi = true}});
  for (const bool quantise : {false, true}) {
    const GltfOptions options{.quantise = quantise};
    check_written(glb_bytes(asset, options), "egg.glb", asset, options);
  }
  const GltfFiles embedded = write_gltf(asset, {.container = GltfContainer::Embedded});
  REQUIRE(embedded.size() == 1);
  check_written(embedded.front().second, "egg.gltf", asset, {.container = GltfContainer::Embedded});
}

TEST_CASE("gltf_writer: a number that differs is found when reading back") {
  const Charted egg;
  const Asset asset = egg.asset();
  const std::string glb = glb_bytes(asset);
  Asset other = asset;
  other.levels[0].positions(7, 1) = std::nextafter(other.levels[0].positions(7, 1), 9.0F);
  CHECK_THROWS_AS(check_written(glb, "egg.glb", other, {}), std::runtime_error);
  other = asset;
  other.levels[0].texcoords[0](7, 1) += 0.01F;
  CHECK_THROWS_AS(check_written(glb, "egg.glb", other, {}), std::runtime_error);
  other = asset;
  std::swap(other.levels[0].indices[3], other.levels[0].indices[4]);
  CHECK_THROWS_AS(check_written(glb, "egg.glb", other, {}), std::runtime_error);
}

TEST_CASE("gltf_writer: bounds are those of the float32 numbers, to the last bit") {
  const Charted egg;
  const Asset asset = egg.asset();
  const json gltf = json_of(glb_bytes(asset));
  const json& accessor = gltf["accessors"][0];
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(accessor["min"][axis].get<double>() ==
          static_cast<double>(asset.levels[0].positions.col(axis).minCoeff()));
    CHECK(accessor["max"][axis].get<double>() ==
          static_cast<double>(asset.levels[0].positions.col(axis).maxCoeff()));
  }
}

TEST_CASE("gltf_writer: indices have 16 bits up to 65,535 vertices") {
  constexpr int uint16 = 5123, uint32 = 5125;
  CHECK(index_type(65535) == uint16);
  CHECK(index_type(65536) == uint32);
}

TEST_CASE("gltf_writer: every view begins at a multiple of four, the file ends at one") {
  Asset asset = Charted().asset();
  asset.images = {{"odd", std::string("\x89PNG") + "xyz"}};
  asset.materials[0].base_colour = 0;
  const std::string glb = glb_bytes(asset);
  CHECK(glb.size() % 4 == 0);
  const json gltf = json_of(glb);
  for (const json& view : gltf["bufferViews"]) CHECK(view["byteOffset"].get<int>() % 4 == 0);
}

TEST_CASE("gltf_writer: only what lies in the unit square can be whole numbers") {
  FloatRows uv(2, 2);
  CHECK(fits_integers({}));
  for (const auto& [lowest, highest, fits] : {std::tuple(0.0F, 1.0F, true),
                                              {0.25F, 0.5F, true},
                                              {-0.125F, 1.0F, false},
                                              {0.0F, 1.125F, false}}) {
    uv << 0.25F, highest, lowest, 0.5F;
    CHECK(fits_integers(uv) == fits);
  }
}

TEST_CASE("gltf_writer: textures wrap in u and are clamped in v") {
  Asset asset = Charted().asset();
  asset.images = {white_asset_image()};
  asset.materials[0].base_colour = 0;
  const json gltf = json_of(glb_bytes(asset));
  CHECK(gltf["samplers"][0]["wrapS"] == 10497);
  CHECK(gltf["samplers"][0]["wrapT"] == 33071);
  CHECK(gltf["textures"][0]["sampler"] == 0);
}

TEST_CASE("gltf_writer: buffers are for vertices or indices, but those of animations for neither") {
  constexpr int of_vertices = 34962, of_indices = 34963;
  const json gltf = json_of(glb_bytes(Charted({}, 1).asset({.morph = Morph::Sphere})));
  const auto view_of = [&](const json& accessor) {
    return gltf["bufferViews"][gltf["accessors"][accessor.get<int>()]["bufferView"].get<int>()];
  };
  const json& primitive = gltf["meshes"][0]["primitives"][0];
  CHECK(view_of(primitive["indices"])["target"] == of_indices);
  for (const json& accessor : primitive["attributes"])
    CHECK(view_of(accessor)["target"] == of_vertices);
  for (const json& accessor : primitive["targets"][0])
    CHECK(view_of(accessor)["target"] == of_vertices);
  const json& sampler = gltf["animations"][0]["samplers"][0];
  for (const char* key : {"input", "output"}) CHECK_FALSE(view_of(sampler[key]).contains("target"));
  CHECK_FALSE(json_of(glb_bytes(long_asset(3)))["meshes"][0]["primitives"][0].contains("targets"));
}

TEST_CASE("gltf_writer: a material gives light by its texture, as strongly as it says") {
  Asset asset = long_asset(3);
  asset.images = {white_asset_image()};
  const auto material = [&] { return json_of(glb_bytes(asset))["materials"][0]; };
  CHECK_FALSE(material().contains("emissiveFactor"));
  asset.materials[0].emissive = 0;
  CHECK(material()["emissiveTexture"] == json{{"index", 0}});
  CHECK(material()["emissiveFactor"] == json::array({1, 1, 1}));
  CHECK_FALSE(material().contains("extensions"));
  asset.materials[0].emissive_strength = 2.5;
  CHECK(material()["extensions"] ==
        json{{"KHR_materials_emissive_strength", {{"emissiveStrength", 2.5}}}});
  asset.materials[0].unlit = true;
  CHECK_FALSE(material().contains("emissiveFactor"));
}

TEST_CASE("gltf_writer: materials after the first are variants, each of its own name") {
  Asset asset = Charted().asset();
  asset.materials = {{.name = "baked"}, {.name = "checker"}, {.name = "area"}};
  const json gltf = json_of(glb_bytes(asset));
  CHECK(gltf["extensions"]["KHR_materials_variants"]["variants"][2]["name"] == "area");
  const json& mappings =
      gltf["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"];
  REQUIRE(mappings.size() == 3);
  CHECK(mappings[1]["material"] == 1);
  CHECK(mappings[1]["variants"] == json::array({1}));
}

TEST_CASE("gltf_writer: what a mesh does not have is not written, and what is there is read") {
  Asset asset = Charted({}, 2).asset({.morph = Morph::Sphere});
  asset.levels[0].normals.resize(0, 0);
  asset.levels[0].targets[0].normals.resize(0, 0);
  asset.levels[0].texcoords.clear();
  asset.materials.clear();
  for (const bool quantise : {false, true}) {
    const GltfOptions options{.quantise = quantise};
    const std::string glb = glb_bytes(asset, options);
    const json primitive = json_of(glb)["meshes"][0]["primitives"][0];
    CHECK(primitive["attributes"].size() == 1);
    CHECK(primitive["targets"][0].size() == 1);
    CHECK_FALSE(primitive.contains("material"));
    check_written(glb, "bare.glb", asset, options);
  }
}

TEST_CASE("gltf_writer: an asset without a level, or a level without triangles, is refused") {
  Asset asset = Charted({}, 1).asset();
  asset.levels.push_back({});
  CHECK_THROWS_AS(glb_bytes(asset), std::invalid_argument);
  asset.levels.clear();
  CHECK_THROWS_AS(glb_bytes(asset), std::invalid_argument);
}

TEST_CASE("gltf_writer: the animation shows one target after the other and ends as it began") {
  const Asset asset = Charted().asset({.morph = Morph::Flat});
  const json gltf = json_of(glb_bytes(asset));
  CHECK(gltf["meshes"][0]["extras"]["targetNames"] == json::array({"sphere", "flat"}));
  const json& sampler = gltf["animations"][0]["samplers"][0];
  const int times = gltf["accessors"][sampler["input"].get<int>()]["count"],
            weights = gltf["accessors"][sampler["output"].get<int>()]["count"];
  CHECK(weights == 2 * times);
  const GltfFiles files = write_gltf(asset, {.container = GltfContainer::Separate, .stem = "egg"});
  const int view = gltf["accessors"][sampler["output"].get<int>()]["bufferView"];
  std::vector<float> numbers(static_cast<std::size_t>(weights));
  std::memcpy(numbers.data(),
              files[1].second.data() + gltf["bufferViews"][view]["byteOffset"].get<int>(),
              numbers.size() * sizeof(float));
  CHECK(numbers == std::vector<float>{0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 0});
}

TEST_CASE("gltf_writer: the flat shape is two wide and one high, north up, about the origin") {
  const SphericalChart chart = Charted({}, 1).chart.chart;
  const Shape flat = flat_shape(chart);
  CHECK(flat.positions.col(0) == (2 * chart.uv.col(0).array() - 1).matrix());
  CHECK(flat.positions.col(1) == (0.5 - chart.uv.col(1).array()).matrix());
  CHECK(flat.positions.col(2).isZero(0));
}

TEST_CASE("gltf_writer: compression is declared required, its buffer of before is not there") {
  const json gltf = json_of(glb_bytes(Charted().asset(), {.compress = true}));
  CHECK(gltf["extensionsRequired"] == json::array({"EXT_meshopt_compression"}));
  CHECK(gltf["buffers"].size() == 2);
  CHECK_FALSE(gltf["buffers"][1].contains("uri"));
  CHECK(gltf["buffers"][0]["byteLength"].get<int>() < gltf["buffers"][1]["byteLength"].get<int>());
}

TEST_CASE(
    "gltf_writer: levels of detail hang on the first node and are in no scene that is shown") {
  Asset asset = Charted().asset();
  asset.levels.push_back(Charted({}, 1).geometry().surface);
  const json gltf = json_of(glb_bytes(asset));
  CHECK(gltf["scenes"][gltf["scene"].get<int>()]["nodes"] == json::array({0}));
  CHECK(gltf["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == json::array({1}));
}

TEST_CASE("gltf_writer: images beside a .gltf are named after it, with signs escaped in the URI") {
  Asset asset = Charted().asset();
  asset.images = {white_asset_image()};
  asset.materials[0].base_colour = 0;
  const GltfFiles files =
      write_gltf(asset, {.container = GltfContainer::Separate, .stem = "an egg"});
  REQUIRE(files.size() == 3);
  CHECK(files[1].first == "an egg.bin");
  CHECK(files[2].first == "an egg_white.png");
  const json gltf = json::parse(files[0].second);
  CHECK(gltf["images"][0]["uri"] == "an%20egg_white.png");
  CHECK(gltf["buffers"][0]["uri"] == "an%20egg.bin");
  CHECK(gltf["buffers"][0]["byteLength"] == files[1].second.size());
}

TEST_CASE("gltf_writer: the same bytes for the same asset and any number of threads") {
  const Charted egg({}, 5);
  const std::string first = glb_bytes(egg.asset({.morph = Morph::Sphere, .threads = 1}));
  CHECK(glb_bytes(egg.asset({.morph = Morph::Sphere, .threads = 3})) == first);
}

TEST_CASE("uri: Base64 as RFC 4648 has it") {
  CHECK(data_uri("a/b", "") == "data:a/b;base64,");
  CHECK(data_uri("a/b", "f") == "data:a/b;base64,Zg==");
  CHECK(data_uri("a/b", "fo") == "data:a/b;base64,Zm8=");
  CHECK(data_uri("a/b", "foobar") == "data:a/b;base64,Zm9vYmFy");
  CHECK(uri_of_file("ä b.png") == "%C3%A4%20b.png");
}

TEST_CASE("in_convention: drawn in a convention or moved into it, a test image is the same") {
  const Image ours = make_test_image(TestImage::Axes, 64);
  for (const ConventionInfo& info : all_conventions()) {
    INFO(info.name);
    const Image drawn = make_test_image(TestImage::Axes, 64, info.convention),
                moved = in_convention(ours, info.convention);
    double most = 0;
    for (size_t i = 0; i < drawn.pixels.size(); ++i)
      most = std::max(most, std::abs(static_cast<double>(drawn.pixels[i] - moved.pixels[i])));
    CHECK(most < 0.02);
  }
}

TEST_CASE("gltf_writer: copyright and extras of the source stand beside our own") {
  Asset asset = long_asset(3);
  CHECK_FALSE(json_of(glb_bytes(asset))["asset"].contains("copyright"));
  CHECK_FALSE(json_of(glb_bytes(asset))["asset"].contains("extras"));
  asset.copyright = "(c) Me";
  asset.source_extras = R"({"license":"CC-BY","sphparam":"theirs"})";
  asset.extras = {{"source", "a.glb"}};
  const json said = json_of(glb_bytes(asset))["asset"];
  CHECK(said["copyright"] == "(c) Me");
  CHECK(said["extras"] == json::parse(R"({"license":"CC-BY","sphparam":{"source":"a.glb"}})"));
  asset.source_extras = "no JSON";
  CHECK(json_of(glb_bytes(asset))["asset"]["extras"] ==
        json::parse(R"({"sphparam":{"source":"a.glb"}})"));
}
