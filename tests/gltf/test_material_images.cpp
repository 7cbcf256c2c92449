#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gltf/images/image_kind.h"
#include "gltf/images/jpeg_head.h"
#include "gltf/images/material_images.h"
#include "gltf/images/normal_image.h"
#include "image/image_codec.h"
#include "io/files/base64.h"
#include "sphparam/bake/bake.h"
#include "sphparam/gltf/export.h"
#include "support/folder.h"
#include "support/test_meshes.h"

/// Images that are given to an export.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;
using Words = std::vector<std::string>;
using namespace std::string_literals;
using namespace std::string_view_literals;

void write(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// 4 × 2 texels of orange, in four channels.
std::string cmyk_jpeg() {
  std::string bytes;
  Base64Reader text(
      "/9j/7gAOQWRvYmUAZAAAAAAA/9sAQwAQCwwODAoQDg0OEhEQExgoGhgWFhgxIyUdKDozPTw5Mzg3QEhcTkBEV0U3OFBt"
      "UVdfYmdoZz5NcXlwZHhcZWdj/8AAFAgAAgAEBEMRAE0RAFkRAEsRAP/EABUAAQEAAAAAAAAAAAAAAAAAAAcB/8QAFBAB"
      "AAAAAAAAAAAAAAAAAAAAAP/aAA4EQwBNAFkASwAAPwBAQfkB/9k=");
  REQUIRE(text.read(text.most_remaining() - 3 - 1, bytes));
  return bytes;
}

/// A JPEG of three channels, as we write it.
std::string common_jpeg() {
  const std::vector<char> bytes = encode_image(Image(16, 8, 3), ImageFormat::Jpeg);
  return {bytes.begin(), bytes.end()};
}

Image with_alphas(std::initializer_list<float> alphas) {
  Image image(static_cast<int>(alphas.size()), 1, 4);
  for (std::size_t i = 0; i < alphas.size(); ++i) image.pixels[4 * i + 3] = alphas.begin()[i];
  return image;
}

MappedMesh ball(int level, const std::string& name) {
  MeshFile file;
  file.mesh = icosphere(level);
  const SphereMap map{file.mesh.positions};
  return MappedMesh({.file = std::move(file), .map = map, .name = name});
}

Look with_normals(const MappedMesh& mesh, const std::string& path) {
  return make_look(mesh, {.look = {.normal = path, .image_width = 64}});
}

}  // namespace

TEST_CASE("jpeg_head: what is not common, also behind a thumbnail, and what is cut off") {
  const std::string jpeg = common_jpeg();
  const JpegHead head = jpeg_head(jpeg);
  CHECK(head.is_common());
  CHECK(head.is_whole);
  CHECK(head.channels == 3);
  CHECK_FALSE(jpeg_head(jpeg.substr(0, jpeg.size() - 2)).is_whole);
  CHECK_FALSE(jpeg_head(cmyk_jpeg()).is_common());
  CHECK(jpeg_head(cmyk_jpeg()).channels == 4);

  const auto frame = [](char process, char bits, char channels) {
    return "\xFF"s + process + "\0\x0B"s + bits + "\0\x02\0\x04"s + channels + "\xFF\xD9"s;
  };
  const std::string start = "\xFF\xD8\xFF\xE1\0\x06\xFF\xC0\xFF\xD9\xFF"s;  // a segment, filling
  for (const auto& [process, bits, channels, common] : {std::tuple('\xC0', 8, 1, true),
                                                        {'\xC2', 8, 3, true},
                                                        {'\xC1', 8, 3, false},
                                                        {'\xC3', 8, 3, false},
                                                        {'\xC9', 8, 3, false},
                                                        {'\xC1', 12, 1, false},
                                                        {'\xC0', 8, 2, false}}) {
    const JpegHead read =
        jpeg_head(start + frame(process, static_cast<char>(bits), static_cast<char>(channels)));
    CHECK(read.process == static_cast<unsigned char>(process) - 0xC0);
    CHECK(read.bits == bits);
    CHECK(read.channels == channels);
    CHECK(read.is_common() == common);
    CHECK(read.is_whole);
  }
  for (std::size_t size = 0; size < jpeg.size(); ++size)
    CHECK_FALSE(jpeg_head(jpeg.substr(0, size)).is_whole);
  CHECK_FALSE(jpeg_head("no image").is_common());
}

TEST_CASE("asset images: a JPEG of CMYK becomes PNG and is told, one that is cut off is refused") {
  const Folder folder;
  Words warnings;
  write(folder / "cmyk.jpg", cmyk_jpeg());
  const GivenImage cmyk = read_asset_image(folder / "cmyk.jpg", "basecolor", warnings);
  CHECK(image_kind(cmyk.asset.bytes).name() == "png"sv);
  REQUIRE(cmyk.pixels.channels == 3);
  CHECK(cmyk.pixels.pixels[0] > 0.95);
  CHECK(cmyk.pixels.pixels[1] == Approx(0.5).margin(0.03));
  CHECK(cmyk.pixels.pixels[2] < 0.05);
  CHECK(warnings == Words{"cmyk.jpg: becomes PNG, for glTF has no JPEG of 4 channels (CMYK)"});

  warnings.clear();
  const std::string jpeg = common_jpeg();
  write(folder / "a.png", jpeg);  // whatever it is called
  CHECK(read_asset_image(folder / "a.png", "basecolor", warnings).asset.bytes == jpeg);
  CHECK(warnings.empty());
  write(folder / "cut.jpg", jpeg.substr(0, jpeg.size() - 2));
  CHECK_THROWS_WITH(read_asset_image(folder / "cut.jpg", "basecolor", warnings),
                    Contains("cut.jpg: is cut off"));
  const std::size_t second =
      4 + 256 * static_cast<unsigned char>(jpeg[4]) + static_cast<unsigned char>(jpeg[5]);
  const std::string stray = jpeg.substr(0, second) + "ab" + jpeg.substr(second);
  CHECK_FALSE(jpeg_head(stray).found);
  write(folder / "stray.jpg", stray);
  const GivenImage given = read_asset_image(folder / "stray.jpg", "basecolor", warnings);
  CHECK(image_kind(given.asset.bytes).name() == "png"sv);
  CHECK(warnings ==
        Words{"stray.jpg: becomes PNG, for stray bytes lie between the segments of this JPEG"});
  write(folder / "cut_stray.jpg", stray.substr(0, stray.size() - 2));
  CHECK_THROWS_WITH(read_asset_image(folder / "cut_stray.jpg", "basecolor", warnings),
                    Contains("cut_stray.jpg: is cut off"));
  write_image(folder / "a.exr", Image(4, 2, 3), {.sample_type = SampleType::Float});
  CHECK_THROWS_WITH(read_asset_image(folder / "a.exr", "basecolor", warnings),
                    Contains("glTF has no EXR: save it as .png"));
}

TEST_CASE("asset images: floats of colours become sRGB, those of our normals what integers have") {
  const Folder folder;
  Words warnings;
  Image light(2, 1, 3);
  light.pixels = {0.5, 0, 1, 0.2140411F, -1, 0};
  const auto read = [&](const std::string& name, const ImageTexts& texts) {
    const std::vector<char> tiff = encode_image(
        light, ImageFormat::Tiff, {.sample_type = SampleType::Float, .metadata = texts});
    write(folder / "a.tif", {tiff.data(), tiff.size()});
    return read_asset_image(folder / "a.tif", name, warnings).pixels.pixels;
  };
  const std::vector<float> colours = read("basecolor", {});
  CHECK(colours[0] == Approx(0.735357).margin(1e-5));  // 1.055 · 0.5^(1/2.4) − 0.055
  CHECK(colours[1] == 0);
  CHECK(colours[2] == 1);
  CHECK(colours[3] == Approx(0.5).margin(1e-5));
  CHECK(read("normal", {{"sphparam:map", "normal-tangent"}, {"sphparam:min", "-1"}}) ==
        std::vector<float>{0.75, 0.5, 1, 0.5F + 0.5F * 0.2140411F, 0, 0.5});
  CHECK(read("orm", {}) == light.pixels);
}

TEST_CASE("asset images: alpha of strangers is a mask, blended, or none") {
  CHECK(alpha_mode_of(Image(4, 2, 3)) == AlphaMode::Opaque);
  CHECK(alpha_mode_of(with_alphas({1, 1})) == AlphaMode::Opaque);
  CHECK(alpha_mode_of(with_alphas({0, 0})) == AlphaMode::Opaque);  // as many programs leave it
  CHECK(alpha_mode_of(with_alphas({0, 1})) == AlphaMode::Mask);
  CHECK(alpha_mode_of(with_alphas({0, 0.5F, 1})) == AlphaMode::Blend);

  const Folder folder;
  const auto mode = [&](const ImageWriteOptions& metadata) {
    write_image(folder / "a.png", with_alphas({0.5F, 1}), metadata);
    const ExportOptions options{.look = {.texture = folder / "a.png"}};
    return make_look(ball(1, "ball.ply"), options).materials.front().alpha_mode;
  };
  CHECK(mode({}) == AlphaMode::Blend);
  // What was baked says it itself.
  CHECK(mode({.metadata = {{"sphparam:map", "basecolor"}}}) == AlphaMode::Opaque);
}

TEST_CASE("asset images: what says that it is no normal map of glTF is refused") {
  const Folder folder;
  const MappedMesh mesh = ball(2, "ball.ply");
  const auto bake_to = [&](const char* field, const char* name, bool down) {
    BakeSettings settings{.width = 64};
    settings.fields.normal_y_down = down;
    bake(mesh, {{field, folder / name}}, settings);
    return folder / name;
  };
  CHECK(with_normals(mesh, bake_to("normal-tangent", "n.png", false)).warnings.empty());
  CHECK_THROWS_AS(with_normals(mesh, bake_to("normal-object", "o.png", false)), LookError);
  CHECK_THROWS_WITH(with_normals(mesh, folder / "o.png"),
                    Contains("o.png shows normal-object") && Contains("--map normal-tangent"));
  CHECK_THROWS_AS(with_normals(mesh, bake_to("normal-tangent", "d.png", true)), LookError);
  CHECK_THROWS_WITH(with_normals(mesh, folder / "d.png"),
                    Contains("+Y down (DirectX)") && Contains("--normal-y gl"));
  write_image(folder / "grey.png", Image(64, 32, 1));
  CHECK_THROWS_WITH(with_normals(mesh, folder / "grey.png"),
                    Contains("grey.png has 1 channel, and a normal map has x, y and z"));
  write_image(folder / "of_strangers.png", Image(64, 32, 3));
  CHECK(with_normals(mesh, folder / "of_strangers.png").normals_given);
}

TEST_CASE("asset images: a normal map that was baked for another mesh is told") {
  const Folder folder;
  const MappedMesh fine = ball(3, "fine.sph.ply"), low = ball(2, "low.ply");
  bake(fine, {{"normal-tangent", folder / "own.png"}}, {.width = 64, .source_name = "fine.glb"});
  BakeSettings settings{.width = 64, .source_name = "fine.glb"};
  settings.target = low;
  bake(fine, {{"normal-tangent", folder / "low.png"}}, settings);
  CHECK(with_normals(fine, folder / "own.png").warnings.empty());
  CHECK(with_normals(low, folder / "low.png").warnings.empty());
  CHECK(with_normals(low, folder / "own.png").warnings ==
        Words{"own.png: baked for fine.glb, not for low.ply: light falls wrong where that is "
              "another mesh or has another map, as a normal map is of one"});
  REQUIRE(with_normals(fine, folder / "low.png").warnings.size() == 1);
  CHECK_THAT(with_normals(fine, folder / "low.png").warnings[0], Contains("baked for low.ply, "));
}

TEST_CASE("look: images that light falls on are told where no light is wanted") {
  const Folder folder;
  write_image(folder / "a_basecolor.png", Image(4, 2, 3));
  write_image(folder / "a_normal-tangent.png", Image(4, 2, 3));
  write_image(folder / "a_emissive.png", Image(4, 2, 3));
  ExportOptions options;
  options.look.folder = folder.path.string();
  CHECK(make_look(ball(1, "ball.ply"), options).warnings.empty());
  options.look.unlit = true;
  const Look look = make_look(ball(1, "ball.ply"), options);
  CHECK(look.images.size() == 1);
  CHECK(look.warnings ==
        Words{"not carried: a_normal-tangent.png (normals) and a_emissive.png (emission): without "
              "light, colours alone are shown"});
  // A mesh without light has none to lose.
  write_image(folder / "a_basecolor.png", Image(4, 2, 3), {.metadata = {{"sphparam:unlit", "1"}}});
  CHECK(make_look(ball(1, "ball.ply"), options).warnings.empty());
}

TEST_CASE("look: an image that was baked says itself how its alpha is seen") {
  const Folder folder;
  ExportOptions options;
  options.look.texture = folder / "a.png";
  for (const auto& [alpha, mode] : {std::pair("blend", AlphaMode::Blend),
                                    {"mask 0.25", AlphaMode::Mask},
                                    {"", AlphaMode::Opaque}}) {
    write_image(folder / "a.png", Image(4, 2, 3),
                {.metadata = {{"sphparam:map", "basecolor"}, {"sphparam:alpha", alpha}}});
    const Material material = make_look(ball(1, "ball.ply"), options).materials[0];
    CHECK(material.alpha_mode == mode);
    if (mode == AlphaMode::Mask) CHECK(material.alpha_cutoff == 0.25);
  }
}

TEST_CASE("look: what is the same all over takes no image, or one texel, which is told") {
  const Folder folder;
  const auto look_of = [&](const std::vector<float>& orm, const std::vector<float>& occlusion,
                           const std::vector<float>& light) {
    ExportOptions options;
    const auto file = [&](const std::string& name, const std::vector<float>& colour) {
      if (colour.empty()) return ""s;
      Image image(8, 4, 3);
      for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = colour[i % 3];
      write_image(folder / name, image);
      return folder / name;
    };
    options.look.orm = file("orm.png", orm);
    options.look.occlusion = file("ao.png", occlusion);
    options.look.emissive = file("light.png", light);
    return make_look(ball(1, "ball.ply"), options);
  };
  const Look rough = look_of({1, 0.2F, 0.6F}, {}, {});
  CHECK(rough.materials[0].metallic_roughness == -1);
  CHECK(rough.materials[0].occlusion == -1);
  CHECK(rough.materials[0].roughness == 0.2);
  CHECK(rough.materials[0].metallic == 0.6);
  CHECK(rough.images.size() == 1);  // the white base colour
  CHECK(rough.remarks ==
        Words{"the image orm is one colour: roughness 0.2 and metallic 0.6, without an "
              "image"});
  const Json written = Json::parse(
      write_gltf(make_asset(ball(1, "ball.ply"), rough), {.container = GltfContainer::Embedded})
          .front()
          .second)["materials"][0];
  CHECK(written["pbrMetallicRoughness"]["roughnessFactor"] == 0.2);
  CHECK(written["pbrMetallicRoughness"]["metallicFactor"] == 0.6);
  CHECK_FALSE(written["pbrMetallicRoughness"].contains("metallicRoughnessTexture"));

  const Look dim = look_of({0.4F, 1, 0}, {}, {});
  CHECK(dim.materials[0].occlusion == 1);
  CHECK(dim.materials[0].metallic_roughness == 1);
  CHECK(decode_image({dim.images[1].bytes.begin(), dim.images[1].bytes.end()}, "o").width == 1);
  CHECK(dim.remarks == Words{"the image orm is one colour: one texel"});

  const Look bright = look_of({0.4F, 1, 0}, {1, 1, 1}, {0, 0, 0});
  CHECK(bright.images.size() == 1);
  CHECK(bright.materials[0].occlusion == -1);
  CHECK(bright.materials[0].emissive == -1);
  CHECK(bright.remarks ==
        Words{"the image orm is one colour: roughness 1 and metallic 0, without an image",
              "the image occlusion is one colour: it darkens nothing, and is left out",
              "the image emissive is one colour: no light, and left out"});

  for (const int width : {1, 2}) {  // one texel stays as it is
    Image red(width, 1, 3);
    for (int column = 0; column < width; ++column) *red.pixel(column, 0) = 1;
    write_image(folder / "red.png", red);
    ExportOptions options;
    options.look.emissive = folder / "red.png";
    CHECK(make_look(ball(1, "ball.ply"), options).remarks.size() == (width == 1 ? 0 : 1));
  }

  const Look lamp = look_of({}, {0.5F, 0.5F, 0.5F}, {1, 0, 0});
  REQUIRE(lamp.images.size() == 3);
  for (std::size_t i : {1, 2}) {
    const std::string& bytes = lamp.images[i].bytes;
    CHECK(decode_image({bytes.begin(), bytes.end()}, "texel").pixels.size() == 3);
  }
}

}  // namespace sphparam::tests
