#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "charted.h"
#include "gltf/stored_chart.h"
#include "gltf/usd/layer_text.h"
#include "gltf/usd/usd_check.h"
#include "io/files/zip_archive.h"
#include "sphparam/gltf/export.h"
#include "sphparam/gltf/usd_writer.h"
#include "sphparam/io/polygons.h"
#include "sphparam/io/safe_file.h"
#include "support/bytes_of.h"
#include "support/folder.h"

/// Layers as text, read by no more than what stands between brackets.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Names = std::vector<std::string>;

/// "= [(1, 2), (3, 4)]" of a declaration as 1 2 3 4.
std::vector<float> array_of(const std::string& layer, const std::string& declaration) {
  const std::size_t at = layer.find("        " + declaration + " = [");
  if (at == std::string::npos) return {};
  std::string list = layer.substr(at + declaration.size() + 12);
  list.resize(list.find(']'));
  for (char& c : list)
    if (c == '(' || c == ')' || c == ',') c = ' ';
  std::istringstream words(list);
  std::vector<float> numbers;
  for (std::string word; words >> word;) numbers.push_back(std::strtof(word.c_str(), nullptr));
  return numbers;
}

std::vector<float> flat(const FloatRows& rows) {
  std::vector<float> numbers;
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Eigen::Index k = 0; k < rows.cols(); ++k) numbers.push_back(rows(i, k));
  return numbers;
}

const std::string png = "\x89PNG of ours", jpeg = "\xFF\xD8\xFF of ours";

/// Everything that a material has.
Asset full_asset() {
  Asset asset = Charted().asset();
  asset.images = {{"basecolor", jpeg}, {"normal", png}, {"orm", png}, {"emissive", png}};
  asset.materials = {{.name = "baked",
                      .base_colour = 0,
                      .normal = 1,
                      .occlusion = 2,
                      .metallic_roughness = 2,
                      .emissive = 3,
                      .emissive_strength = 2.5,
                      .alpha_mode = AlphaMode::Mask,
                      .alpha_cutoff = 0.25,
                      .double_sided = true,
                      .finish = {.clearcoat = 1, .clearcoat_roughness = 0.5, .ior = 1.25}}};
  return asset;
}

std::string layer_of(const Asset& asset) { return write_usd(asset, "egg").front().second; }

/// Of a material: what stands in its prim of this name.
std::string shader(const std::string& layer, const std::string& name) {
  const std::size_t at = layer.find("def Shader \"" + name + "\"\n");
  if (at == std::string::npos) return "";
  return layer.substr(at, layer.find('}', at) - at);
}

MappedMesh mapped_ball() {
  MeshFile file;
  file.mesh = icosphere(2);
  SphereMap map{file.mesh.positions};
  return MappedMesh({.file = std::move(file), .map = std::move(map), .name = "ball.obj"});
}

/// A ball whose map crowds about the north pole, 2^-halvings times as far from it: v is small
/// there, and floats are finer than near 1.
MappedMesh about_north(int halvings) {
  MeshFile file;
  file.mesh = icosphere(2);
  SphereMap map{file.mesh.positions};
  const double shrunk = std::ldexp(1, -halvings);
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    const double z = map.points(v, 2);
    const double t = shrunk * shrunk * (1 - z) / (1 + z + 1e-300);  // stereographic, squared
    const double radius = std::hypot(map.points(v, 0), map.points(v, 1));
    if (radius > 0) map.points.row(v).head(2) *= 2 * std::sqrt(t) / (1 + t) / radius;
    if (z > -1) map.points(v, 2) = (1 - t) / (1 + t);
  }
  return MappedMesh({.file = std::move(file), .map = std::move(map), .name = "ball.obj"});
}

const ExportOptions small{.look = {.image_width = 64}};

}  // namespace

TEST_CASE("USD: numbers read back as the floats of the asset, v from below") {
  const Asset asset = Charted().asset();
  const Surface& mesh = asset.levels.front();
  const std::string layer = layer_of(asset);
  CHECK(array_of(layer, "point3f[] points") == flat(mesh.positions));
  CHECK(array_of(layer, "normal3f[] normals") == flat(mesh.normals));
  CHECK(array_of(layer, "int[] faceVertexIndices") ==
        std::vector<float>(mesh.indices.begin(), mesh.indices.end()));
  CHECK(array_of(layer, "int[] faceVertexCounts") ==
        std::vector<float>(mesh.indices.size() / 3, 3));
  FloatRows st = mesh.texcoords.front();
  for (Eigen::Index i = 0; i < st.rows(); ++i) st(i, 1) = 1 - st(i, 1);
  CHECK(array_of(layer, "texCoord2f[] primvars:st") == flat(st));
  FloatRows extent(2, 3);
  extent << mesh.positions.colwise().minCoeff(), mesh.positions.colwise().maxCoeff();
  CHECK(array_of(layer, "float3[] extent") == flat(extent));
}

TEST_CASE("USD: a layer says its axes, its unit, its prim, and that nothing subdivides the mesh") {
  Asset asset = Charted().asset();
  asset.name = "2 äpfel";
  asset.copyright = "A \"museum\"\nof\\clay";
  asset.extras = {{"up", "y"}, {"level 1", "\x1B\xFF"}};
  const std::string layer = layer_of(asset);
  CHECK(
      layer.starts_with("#usda 1.0\n(\n    customLayerData = {\n        " + usd_creator() + "\n"));
  for (const char* line :
       {"        string copyright = \"A \\\"museum\\\"\\nof\\\\clay\"\n",
        "            string up = \"y\"\n", "            string level_1 = \" \xEF\xBF\xBD\"\n",
        "    defaultPrim = \"_2___pfel\"\n", "    metersPerUnit = 1\n", "    upAxis = \"Y\"\n",
        "\ndef Xform \"_2___pfel\" (\n", "    def Mesh \"mesh\" (\n",
        "        uniform token subdivisionScheme = \"none\"\n",
        "        uniform bool doubleSided = 0\n",
        "        rel material:binding = </_2___pfel/materials/plain>\n",
        "            interpolation = \"vertex\"\n"})
    CHECK_THAT(layer, Contains(line));
  CHECK_THAT(layer, !Contains("xformOp") && !Contains("variantSet") && !Contains(" \n"));
  asset.levels[0].origin = {391234, 34.5, -5821456};
  CHECK_THAT(
      layer_of(asset),
      Contains("double3 xformOp:translate = (391234, 34.5, -5821456)\n        uniform token[] "
               "xformOpOrder = [\"xformOp:translate\"]\n"));
}

TEST_CASE("USD: strings are UTF-8 in quotes, whatever bytes they are of") {
  const std::string no = "\xEF\xBF\xBD";
  for (const auto& [text, quoted] : {std::pair<std::string, std::string>("", ""),
                                     {"a\"b\\c\nd\te\rf\x01g", "a\\\"b\\\\c\\nd\\te\\rf g"},
                                     {"\u00e4\u20ac\U0001F600", "\u00e4\u20ac\U0001F600"},
                                     {"\x80", no},                             // no first byte
                                     {"\xC1\x81", no + no},                    // one byte would do
                                     {"\xE0\x9F\xBF", no + no + no},           // two would
                                     {"\xED\xA0\x80", no + no + no},           // half of a pair
                                     {"\xF4\x90\x80\x80", no + no + no + no},  // beyond the last
                                     {"\xC3x", no + "x"},
                                     {"\xE2\x82", no + no}})
    CHECK(usd_string(text) == "\"" + quoted + "\"");
}

TEST_CASE("USD: images become readers, each channel goes to its input") {
  const std::string layer = layer_of(full_asset());
  const std::string in = "</egg/materials/baked/", surface = shader(layer, "surface");
  for (const auto& [input, output] :
       {std::pair("color3f inputs:diffuseColor", "base_colour.outputs:rgb"),
        {"normal3f inputs:normal", "normal.outputs:rgb"},
        {"float inputs:occlusion", "orm.outputs:r"},
        {"float inputs:roughness", "orm.outputs:g"},
        {"float inputs:metallic", "orm.outputs:b"},
        {"color3f inputs:emissiveColor", "emissive.outputs:rgb"},
        {"float inputs:opacity", "base_colour.outputs:a"}})
    CHECK_THAT(surface, Contains(std::string(input) + ".connect = " + in + output + ">\n"));
  for (const char* value :
       {"uniform token info:id = \"UsdPreviewSurface\"\n", "float inputs:opacityThreshold = 0.25\n",
        "float inputs:clearcoat = 1\n", "float inputs:clearcoatRoughness = 0.5\n",
        "float inputs:ior = 1.25\n"})
    CHECK_THAT(surface, Contains(value));
  CHECK_THAT(shader(layer, "base_colour"), Contains("@./egg_basecolor.jpg@") &&
                                               Contains("sourceColorSpace = \"sRGB\"") &&
                                               Contains("wrapS = \"repeat\"") &&
                                               Contains("wrapT = \"clamp\"") && !Contains("scale"));
  CHECK_THAT(shader(layer, "normal"), Contains("@./egg_normal.png@") &&
                                          Contains("sourceColorSpace = \"raw\"") &&
                                          Contains("inputs:scale = (2, 2, 2, 1)") &&
                                          Contains("inputs:bias = (-1, -1, -1, 0)"));
  CHECK_THAT(shader(layer, "orm"), Contains("\"raw\"") && !Contains("bias"));
  CHECK_THAT(shader(layer, "emissive"),
             Contains("\"sRGB\"") && Contains("inputs:scale = (2.5, 2.5, 2.5, 1)"));
  CHECK_THAT(shader(layer, "st"), Contains("string inputs:varname = \"st\""));
  CHECK(shader(layer, "occlusion").empty());
  CHECK_THAT(layer, Contains("uniform bool doubleSided = 1\n"));
}

TEST_CASE("USD: numbers where there is no image, an occlusion of its own, blended alpha") {
  Asset asset = full_asset();
  asset.materials[0].metallic_roughness = -1;
  asset.materials[0].roughness = 0.5;
  asset.materials[0].metallic = 0.125;
  asset.materials[0].alpha_mode = AlphaMode::Blend;
  const std::string surface = shader(layer_of(asset), "surface");
  CHECK_THAT(
      surface,
      Contains("float inputs:roughness = 0.5\n") && Contains("float inputs:metallic = 0.125\n") &&
          Contains("inputs:occlusion.connect = </egg/materials/baked/occlusion.outputs:r>") &&
          Contains("inputs:opacity.connect") && !Contains("opacityThreshold"));
  asset.materials[0].alpha_mode = AlphaMode::Opaque;
  CHECK_THAT(layer_of(asset), !Contains("opacity"));
}

TEST_CASE("USD: without light a colour is emitted, and none is reflected") {
  Asset asset = full_asset();
  asset.materials[0].unlit = true;
  const std::string layer = layer_of(asset);
  CHECK_THAT(
      shader(layer, "surface"),
      Contains("inputs:emissiveColor.connect = </egg/materials/baked/base_colour.outputs:rgb>") &&
          Contains("color3f inputs:diffuseColor = (0, 0, 0)\n") &&
          Contains("int inputs:useSpecularWorkflow = 1\n") &&
          Contains("color3f inputs:specularColor = (0, 0, 0)\n") && !Contains("normal"));
  CHECK(write_usd(asset).size() == 2);  // what is not seen is not written
}

TEST_CASE("USD: more materials are variants, which bind above the mesh") {
  Asset asset = full_asset();
  asset.materials.push_back({.name = "a look", .base_colour = 1});
  asset.materials.push_back({.name = "a_look"});
  const std::string layer = layer_of(asset);
  for (const char* text :
       {"        rel material:binding = </egg/materials/baked>\n",
        "    prepend variantSets = \"look\"\n    variants = {\n        string look = \"baked\"\n   "
        " }\n",
        "    variantSet \"look\" = {\n        \"baked\" {\n",
        "        \"a_look\" {\n            rel material:binding = </egg/materials/a_look> (\n"
        "                bindMaterialAs = \"strongerThanDescendants\"\n            )\n        }\n",
        "        \"a_look_2\" {\n"})
    CHECK_THAT(layer, Contains(text));
}

TEST_CASE("USD: colours of vertices are seen, instead of a base colour") {
  Asset asset = full_asset();
  asset.levels[0].colours.assign(asset.levels[0].vertex_count(), {65535, 13107, 0, 65535});
  const std::string layer = layer_of(asset);
  const std::vector<float> colours = array_of(layer, "color3f[] primvars:displayColor");
  REQUIRE(colours.size() == 3 * asset.levels[0].vertex_count());
  CHECK(std::vector<float>(colours.begin(), colours.begin() + 3) == std::vector<float>{1, 0.2F, 0});
  CHECK_THAT(
      shader(layer, "surface"),
      Contains(
          "inputs:diffuseColor.connect = </egg/materials/baked/vertex_colour.outputs:result>"));
  CHECK_THAT(shader(layer, "vertex_colour"),
             Contains("UsdPrimvarReader_float3") && Contains("varname = \"displayColor\""));
  CHECK_THAT(layer, !Contains("basecolor"));
}

TEST_CASE("USD: other numbers of vertices are primvars") {
  Asset asset = Charted().asset();
  Surface& mesh = asset.levels[0];
  const auto count = static_cast<Eigen::Index>(mesh.vertex_count());
  mesh.texcoords.push_back(FloatRows::Constant(count, 2, 0.25F));
  mesh.custom = {{"_THETA_PHI", FloatRows::Constant(count, 2, 3)},
                 {"_ONE", FloatRows::Ones(count, 1)}};
  const std::string layer = layer_of(asset);
  CHECK(array_of(layer, "texCoord2f[] primvars:st1")[1] == 0.75F);
  CHECK(array_of(layer, "float2[] primvars:_THETA_PHI").size() == 2 * mesh.vertex_count());
  CHECK_THAT(layer, Contains("float[] primvars:_ONE = [1, 1, "));
}

TEST_CASE("USD: a package has the layer first, and each file from a multiple of 64 bytes on") {
  const Asset asset = full_asset();
  const std::string bytes = usdz_bytes(asset), name = "egg.usdz";
  CHECK(bytes.substr(30, 10) == "model.usda");
  const ZipArchive archive(bytes, name);
  const std::string layer = archive.unpacked("model.usda", bytes.size());
  CHECK_THAT(layer, Contains("@textures/basecolor.jpg@") && Contains("@textures/orm.png@"));
  CHECK(archive.unpacked("textures/basecolor.jpg", 100) == jpeg);
  CHECK(archive.unpacked("textures/emissive.png", 100) == png);
  for (const std::string& begin : {layer, jpeg, png}) CHECK(bytes.find(begin) % 64 == 0);
  CHECK(usdz_bytes(asset) == bytes);
}

TEST_CASE("USD: files come with the images they name, and never replace those of others") {
  const Folder folder;
  const Asset asset = make_asset(mapped_ball(), small);
  write_asset(folder / "a.usda", asset);
  CHECK(folder.names() == Names{"a.usda", "a_checker.png"});
  CHECK(asset_files(folder / "a.usda", asset) ==
        Names{folder / "a.usda", folder / "a_checker.png"});
  CHECK(bytes_of(folder / "a_checker.png") == asset.images[0].bytes);
  CHECK(bytes_of(folder / "a.usda") == write_usd(asset, "a").front().second);
  // What it wrote itself it may replace, whatever the image is now.
  const ExportOptions other{.look = {.image_width = 128}};
  CHECK_NOTHROW(write_asset(folder / "a.usda", make_asset(mapped_ball(), other)));
  std::filesystem::remove(folder / "a.usda");
  CHECK_THROWS_AS(write_asset(folder / "a.usda", asset), WriteError);
  write_file(folder / "a.usda", "#usda 1.0\n# of a stranger: @./a_checker.png@\n");
  CHECK_THROWS_AS(write_asset(folder / "a.usda", asset), WriteError);
  write_asset(folder / "b.usdz", asset);
  CHECK(asset_files(folder / "b.usdz", asset) == Names{folder / "b.usdz"});
  CHECK(bytes_of(folder / "b.usdz") == usdz_bytes(asset));
}

TEST_CASE("USD: names with an @ stand between three, names with three are refused") {
  const Folder folder;
  const Asset asset = make_asset(mapped_ball(), small);
  write_asset(folder / "a@2x.usda", asset);
  CHECK_THAT(bytes_of(folder / "a@2x.usda"), Contains(" = @@@./a@2x_checker.png@@@\n"));
  CHECK_NOTHROW(
      write_asset(folder / "a@2x.usda", make_asset(mapped_ball(), {.look = {.image_width = 128}})));
  for (const char* name : {"a@@@b.usda", "a\nb.usda"})
    CHECK_THROWS_AS(require_export_place(folder / name), WriteError);
}

TEST_CASE("USD: what was read back is compared number by number") {
  const Asset asset = Charted().asset();
  const std::string layer = layer_of(asset);
  CHECK_NOTHROW(check_written_usd(layer, "a.usda", asset));
  CHECK_NOTHROW(check_written_usd(usdz_bytes(asset), "a.usdz", asset));
  for (const auto& [declaration, what] :
       {std::pair("point3f[] points = [(", "positions"),
        {"int[] faceVertexIndices = [", "faces"},
        {"int[] faceVertexCounts = [", "faces"},
        {"texCoord2f[] primvars:st = [(", "texture coordinates"}}) {
    const std::size_t at = layer.find(declaration) + std::string(declaration).size();
    REQUIRE(at < layer.size());
    const std::string message = std::string("a.usda, read back: ") + what + " differ";
    std::string changed = layer;
    CHECK_THROWS_WITH(check_written_usd(changed.insert(at, "7"), "a.usda", asset), message);
    changed = layer;
    changed.insert(changed.find(']', at), std::string(1, ' ') + "8");  // one more than there are
    CHECK_THROWS_WITH(check_written_usd(changed, "a.usda", asset), message);
    changed = layer;
    changed.replace(layer.find(declaration), 1, "x");
    CHECK_THROWS_WITH(check_written_usd(changed, "a.usda", asset), message);
  }
}

TEST_CASE("USD: a control mesh keeps its quads, and says what subdivides it") {
  // A box twice as long as wide, z up: three pairs of sides.
  MeshFile file;
  Polygons quads;
  file.mesh.positions.resize(8, 3);
  for (int v = 0; v < 8; ++v) file.mesh.positions.row(v) << 2 * (v & 1), v >> 1 & 1, v >> 2;
  for (const int v : {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5}) {
    quads.add_corner(v);
    if (quads.open_degree() == 4) REQUIRE(quads.close_polygon({}).empty());
  }
  adopt_triangulation(file, triangulate(file.mesh.positions, quads));
  file.corner_texcoords = CornerTexcoords(36, 2);
  for (Eigen::Index corner = 0; corner < 36; ++corner)
    file.corner_texcoords->row(corner) << file.mesh.triangles.data()[corner] / 8.0, 0.75;
  file.comments = {"displacement: d.exr"};
  file.set_vertex_property({"height", ScalarType::Float64, {1, 2, 3, 4, 5, 6, 7, 8}});
  SphereMap map{
      (file.mesh.positions.rowwise() - Eigen::RowVector3d(1, 0.5, 0.5)).rowwise().normalized()};
  const MappedMesh cage({.file = file, .map = map, .polygons = quads, .name = "cube:1"});
  const Folder folder;
  PendingFiles files;
  CHECK(add_usd_cage(files, folder / "base.usda", cage, false) ==
        Names{"not carried: height of vertices: .ply has room for that"});
  add_usd_cage(files, folder / "base.usdz", cage, true);
  files.publish();
  const std::string layer = bytes_of(folder / "base.usda");
  CHECK(array_of(layer, "int[] faceVertexCounts") == std::vector<float>(6, 4));
  CHECK(array_of(layer, "int[] faceVertexIndices") ==
        std::vector<float>(quads.corners.begin(), quads.corners.end()));
  const std::vector<float> points = array_of(layer, "point3f[] points");
  CHECK(std::vector<float>(points.begin() + 12, points.begin() + 18) ==
        std::vector<float>{0, 1, 0, 2, 1, 0});  // what was up z is y
  std::vector<float> st;
  for (const int v : quads.corners) st.insert(st.end(), {static_cast<float>(v) / 8, 0.75F});
  CHECK(array_of(layer, "texCoord2f[] primvars:st") == st);
  for (const char* line :
       {"        uniform token subdivisionScheme = \"catmullClark\"\n",
        "        uniform token faceVaryingLinearInterpolation = \"all\"\n",
        "            interpolation = \"faceVarying\"\n",
        "            string comments = \"displacement: d.exr\"\n", "    defaultPrim = \"base\"\n"})
    CHECK_THAT(layer, Contains(line));
  const std::string package = bytes_of(folder / "base.usdz");
  CHECK(package.find("#usda 1.0") == 64);
  CHECK_THAT(package, Contains("subdivisionScheme = \"loop\""));
}

TEST_CASE("USD: what these files do not carry is told in a line") {
  Asset asset = full_asset();
  CHECK(beyond_usd(asset).empty());
  asset.levels[0].targets.emplace_back();
  asset.levels.push_back(asset.levels[0]);
  asset.materials[0].finish.sheen = {1, 0, 0};
  asset.materials.push_back(asset.materials[0]);
  CHECK(
      beyond_usd(asset) ==
      Names{"not carried: the animation, levels of detail and KHR_materials_sheen: .glb and .gltf "
            "have room for that"});
}

TEST_CASE("USD: where float32 folds (u, 1 - v), a chart made for it does not, or says so") {
  const Folder folder;
  ExportOptions options = small;
  const Asset plain = make_asset(about_north(22), options);
  CHECK(plain.charts[0].stored.one_to_one());
  CHECK(folds_by_flipping(plain) > 0);
  CHECK_THROWS_WITH(write_asset(folder / "a.usda", plain), Contains("would fold in (u, 1 - v)"));
  CHECK_NOTHROW(write_asset(folder / "a.glb", plain));
  options.upward_v = true;
  const Asset asset = make_asset(about_north(22), options);
  CHECK(asset.charts[0].stored.one_to_one());
  CHECK(folds_by_flipping(asset) == 0);
  CHECK_NOTHROW(write_asset(folder / "a.usda", asset));
  const Asset crowded = make_asset(about_north(21), options);  // no room is found
  CHECK(crowded.charts[0].stored.folded.size() ==
        static_cast<std::size_t>(folds_by_flipping(crowded)));
  REQUIRE_FALSE(crowded.warnings.empty());
  CHECK_THAT(crowded.warnings.back(),
             Contains("5 of") && Contains("triangles fold in (u, v) as stored"));
  CHECK_NOTHROW(write_asset(folder / "b.usda", crowded));
}

TEST_CASE("USD: what has no triangles, 16-bit coordinates or WebP is refused") {
  Asset asset = full_asset();
  asset.images[0].bytes = "RIFF....WEBP";
  CHECK_THROWS_AS(write_usd(asset), std::invalid_argument);
  asset = full_asset();
  asset.quantised = true;
  CHECK_THROWS_AS(usdz_bytes(asset), std::invalid_argument);
  asset = full_asset();
  asset.levels[0].indices.clear();
  CHECK_THROWS_AS(write_usd(asset), std::invalid_argument);
}

}  // namespace sphparam::tests
