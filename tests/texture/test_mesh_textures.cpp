#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "image/image_codec.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/texture/mesh_textures.h"
#include "support/folder.h"
#include "support/test_meshes.h"
#include "texture/read_textures.h"
#include "texture/source_texture.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Contains;

namespace {

MeshFile ball(bool with_texcoords) {
  MeshFile file;
  file.mesh = icosphere(1);
  const auto vertices = static_cast<size_t>(file.mesh.vertex_count());
  for (const char* name : {"s", "t"}) {
    if (with_texcoords)
      file.set_vertex_property({name, ScalarType::Float32, std::vector<double>(vertices, 0.5)});
  }
  return file;
}

std::string green_png(const Folder& folder) {
  Image image(2, 2, 3);
  for (size_t i = 1; i < image.pixels.size(); i += 3) image.pixels[i] = 1;
  const std::vector<char> bytes = encode_image(image, ImageFormat::Png);
  const std::string path = folder / "green.png";
  write_file(path, {bytes.begin(), bytes.end()});
  return path;
}

}  // namespace

TEST_CASE("shown textures: an image that is named is on all of the mesh, where it has a place") {
  const Folder folder;
  const std::string image = green_png(folder);
  const ShownTextures shown = shown_textures(ball(true), "ball.ply", image);
  CHECK(shown.warning.empty());
  REQUIRE(shown.textures->of_materials.size() == 1);
  CHECK(shown.textures->one_for_all);
  CHECK_THROWS_WITH(shown_textures(ball(false), "ball.ply", image),
                    "ball.ply has no texture coordinates, so its texture has no place");
  std::filesystem::remove(image);
  CHECK_THROWS_AS(shown_textures(ball(true), "ball.ply", image), ImageError);
}

TEST_CASE("read_textures: of specular colour and glossiness an image is made, texel by texel") {
  // Red plastic, and gold, half as glossy; the specular image is twice as large.
  Image diffuse(1, 2, 4), specular(2, 4, 4);
  for (int y = 0; y < 2; ++y) {
    const std::array<float, 4> colour =
        y == 0 ? std::array<float, 4>{1, 0, 0, 0.5F} : std::array<float, 4>{0, 0, 0, 1};
    std::ranges::copy(colour, diffuse.pixel(0, y));
  }
  for (int i = 0; i < 8; ++i) {
    const std::array<float, 4> colour =
        i < 4 ? std::array<float, 4>{0, 0, 0, 1} : std::array<float, 4>{1, 0.8F, 0.2F, 0.5F};
    std::ranges::copy(colour, specular.pixel(i % 2, i / 2));
  }
  const auto embedded = [](const Image& image) {
    return std::make_shared<const std::vector<char>>(encode_image(image, ImageFormat::Png));
  };
  SpecularGlossiness parts;
  parts.diffuse = {.image = "d.png", .bytes = embedded(diffuse)};
  parts.specular = {.image = "s.png", .bytes = embedded(specular)};
  MaterialTexture texture{.image = "d.png and s.png"};
  texture.made_of = std::make_shared<const SpecularGlossiness>(parts);
  CHECK(why_unusable(texture).empty());

  const MeshFile file = ball(true);
  const auto texel = [&](TexelKind kind, int x, int y) {
    const auto image = TextureReader(file, kind, 1).read(texture, "skin").image;
    REQUIRE(image->levels()[0].width == 2);
    REQUIRE(image->levels()[0].height == 4);
    const std::uint16_t* const at =
        &image->levels()[0].texels[static_cast<size_t>(4 * (2 * y + x))];
    return std::array<double, 4>{at[0] / 65535.0, at[1] / 65535.0, at[2] / 65535.0,
                                 at[3] / 65535.0};
  };
  const auto near = [](double x) { return Approx(x).margin(0.003); };
  const auto plastic = texel(TexelKind::Colour, 1, 1), gold = texel(TexelKind::Colour, 0, 2);
  CHECK(plastic[0] == near(1));
  CHECK(plastic[1] == near(0));
  CHECK(plastic[3] == near(0.5));
  CHECK(gold[0] == near(1));
  CHECK(gold[1] == near(std::pow((0.8 + 0.055) / 1.055, 2.4)));
  const auto numbers = texel(TexelKind::Number, 0, 0), of_gold = texel(TexelKind::Number, 1, 3);
  CHECK(numbers[1] == near(0));
  CHECK(numbers[2] == near(0));
  CHECK(of_gold[1] == near(0.5));
  CHECK(of_gold[2] == near(1));

  parts.specular.problem = "it is not there";
  texture.made_of = std::make_shared<const SpecularGlossiness>(parts);
  CHECK(why_unusable(texture) == "it is not there");
}

TEST_CASE("read_textures: images of one name are told apart by folder, path and bytes") {
  const auto grey = [](float value) {
    Image image(1, 1, 3);
    std::ranges::fill(image.pixels, value);
    return std::make_shared<const std::vector<char>>(encode_image(image, ImageFormat::Png));
  };
  const MeshFile file = ball(true);
  TextureReader reader(file, TexelKind::Number, 1);
  const auto texel = [&](const MaterialTexture& texture) {
    return reader.read(texture, "skin").image->levels()[0].texels[0];
  };
  const MaterialTexture white{.image = "tex.png", .bytes = grey(1)};
  CHECK(texel(white) == 65535);
  CHECK(texel({.image = "tex.png", .bytes = grey(0)}) == 0);
  CHECK(reader.read(white, "a").image == reader.read(white, "b").image);  // decoded once

  const Folder place;
  for (const char* folder : {"a", "b"}) std::filesystem::create_directory(place / folder);
  const auto write = [&](const char* path, float value) {
    const std::shared_ptr<const std::vector<char>> bytes = grey(value);
    write_file(place / path, {bytes->begin(), bytes->end()});
  };
  write("a/tex.png", 1);
  write("b/tex.png", 0);
  const auto in = [&](const std::string& folder, const std::string& path) {
    return texel({.image = "tex.png", .folder = folder, .path = path});
  };
  CHECK(in(place.path, "a/tex.png") == 65535);
  CHECK(in(place.path, "b/tex.png") == 0);
  CHECK(in(place / "a", "tex.png") == 65535);
  CHECK(in(place / "b", "tex.png") == 0);
}

TEST_CASE("read_textures: a texture that cannot be used is refused although its image is known") {
  const MeshFile file = ball(true);
  TextureReader reader(file, TexelKind::Colour, 1);
  MaterialTexture texture{.image = "tex.png"};
  texture.bytes =
      std::make_shared<const std::vector<char>>(encode_image(Image(1, 1, 3), ImageFormat::Png));
  CHECK(reader.read(texture, "a").image);
  texture.problem = "it is moved too far";
  CHECK_THROWS_WITH(reader.read(texture, "b"), "material b, tex.png: it is moved too far");
}

TEST_CASE("read_textures: heights become normals as the texture repeats or ends at its borders") {
  Image heights(4, 4, 1);
  heights.pixel(0, 0)[0] = 1;
  MaterialTexture bump{.image = "bump.png", .bump = 1};
  bump.bytes = std::make_shared<const std::vector<char>>(encode_image(heights, ImageFormat::Png));
  MaterialTexture clamped = bump;
  clamped.wrap_s = Wrapping::Clamp;
  const MeshFile file = ball(true);
  TextureReader reader(file, TexelKind::Number, 1);
  const auto slope_at_right = [&](const MaterialTexture& texture) {
    return reader.read(texture, "skin").image->levels()[0].texels[size_t{4} * 3];
  };
  CHECK(slope_at_right(bump) < 20000);  // it rises to the right, where the image begins again
  CHECK(slope_at_right(clamped) == Approx(32768).margin(1));
}

TEST_CASE("read_textures: colours of an EXR are linear, those of a PNG are sRGB") {
  Image grey(1, 1, 3);
  std::ranges::fill(grey.pixels, 0.5F);
  const MeshFile file = ball(true);
  const auto texel = [&](ImageFormat format, SampleType type) {
    MaterialTexture texture{.image = "grey"};
    texture.bytes = std::make_shared<const std::vector<char>>(
        encode_image(grey, format, {.sample_type = type}));
    return TextureReader(file, TexelKind::Colour, 1)
        .read(texture, "skin")
        .image->levels()[0]
        .texels[0];
  };
  CHECK(texel(ImageFormat::Exr, SampleType::Float) == Approx(32768).margin(1));
  CHECK(texel(ImageFormat::Png, SampleType::Uint16) == Approx(14027).margin(20));
}

namespace {

std::string big_endian(std::uint32_t x, int size) {
  std::string bytes;
  for (int i = size; i-- > 0;) bytes += static_cast<char>(x >> (8 * i) & 255);
  return bytes;
}

/// A profile of three primaries, in 65536ths, and a curve that is a power, in 256ths.
std::string profile_of(const std::array<std::array<std::uint32_t, 3>, 3>& primaries,
                       std::uint32_t power, const std::string& name) {
  std::vector<std::pair<std::string, std::string>> tags;
  const std::string none(4, '\0');
  for (size_t i = 0; i < 3; ++i) {
    std::string xyz = "XYZ " + none;
    for (const std::uint32_t x : primaries[i]) xyz += big_endian(x, 4);
    tags.emplace_back(std::string(1, "rgb"[i]) + "XYZ", xyz);
    tags.emplace_back(std::string(1, "rgb"[i]) + "TRC",
                      "curv" + none + big_endian(1, 4) + big_endian(power, 2) + none.substr(2));
  }
  const auto length = static_cast<std::uint32_t>(name.size() + 1);
  std::string said = "desc" + none + big_endian(length, 4) + name + std::string(80, '\0');
  said.resize((said.size() + 3) / 4 * 4);
  tags.emplace_back("desc", said);
  std::string table = big_endian(static_cast<std::uint32_t>(tags.size()), 4), data;
  for (const auto& [tag, value] : tags) {
    const size_t at = 128 + 4 + 12 * tags.size() + data.size();
    table += tag + big_endian(static_cast<std::uint32_t>(at), 4) +
             big_endian(static_cast<std::uint32_t>(value.size()), 4);
    data += value;
  }
  std::string head = std::string(8, '\0') + big_endian(0x02400000, 4) + "mntrRGB XYZ ";
  head += std::string(12, '\0') + "acsp";
  head.resize(128, '\0');
  const std::string all = head + table + data;
  return big_endian(static_cast<std::uint32_t>(all.size()), 4) + all.substr(4);
}

/// The ball with a JPEG that has the profile.
MeshFile with_profile(const std::string& profile) {
  const std::vector<char> jpeg = encode_image(Image(8, 8, 3), ImageFormat::Jpeg);
  const std::string segment = "ICC_PROFILE" + std::string(1, '\0') + "\x01\x01" + profile;
  const std::string marked =
      "\xff\xe2" + big_endian(static_cast<std::uint32_t>(segment.size() + 2), 2) + segment;
  auto bytes = std::make_shared<std::vector<char>>(jpeg.begin(), jpeg.begin() + 2);
  bytes->insert(bytes->end(), marked.begin(), marked.end());
  bytes->insert(bytes->end(), jpeg.begin() + 2, jpeg.end());
  MeshFile file = ball(true);
  file.materials = {"skin"};
  file.base_colours.resize(1);
  file.base_colours[0].image = "skin.jpg";
  file.base_colours[0].bytes = bytes;
  return file;
}

}  // namespace

TEST_CASE("read_textures: a colour profile beside sRGB's is told, by what it says of colours") {
  const auto warnings = [](const std::string& profile) {
    return warnings_of(read_textures(with_profile(profile), 1));
  };
  constexpr std::array<std::array<std::uint32_t, 3>, 3> srgb = {
      {{28577, 14581, 912}, {25238, 46983, 6363}, {9380, 3973, 46786}}};
  constexpr std::array<std::array<std::uint32_t, 3>, 3> adobe = {
      {{39960, 20389, 1276}, {13453, 41004, 3977}, {9775, 4141, 48793}}};
  constexpr std::uint32_t gamma = 563;  // 2.2
  CHECK(warnings(profile_of(srgb, gamma, "whatever")).empty());
  CHECK(warnings(profile_of(adobe, gamma, "Adobe RGB (1998)")) ==
        std::vector<std::string>{"skin.jpg: its colours are taken as sRGB; its colour profile, "
                                 "Adobe RGB (1998), is not heeded (convert the image to sRGB)"});
  CHECK(warnings(profile_of(srgb, 256, "linear")).size() == 1);
  CHECK(warnings(std::string(200, 'x')).size() == 1);  // no profile that one knows
  CHECK_THAT(shown_textures(with_profile(profile_of(adobe, gamma, "Adobe")), "ball").warning,
             Contains("taken as sRGB"));
}

TEST_CASE("read_textures: BMP and TGA are images of materials") {
  const std::string head = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 24, 0};
  const std::string tga = head + std::string("\0\xff\0", 3);
  MaterialTexture texture{.image = "skin.tga"};
  texture.bytes = std::make_shared<const std::vector<char>>(tga.begin(), tga.end());
  CHECK(why_unusable(texture).empty());
  const MeshFile file = ball(true);
  const SourceTexture green = TextureReader(file, TexelKind::Colour, 1).read(texture, "skin");
  CHECK(green.image->levels()[0].texels[1] == 65535);
}

TEST_CASE("shown textures: what stands against those of a file is told, the mesh shown without") {
  const ShownTextures none = shown_textures(ball(false), "ball.ply");
  CHECK(none.warning.empty());
  MeshFile glass = ball(false);
  glass.materials = {"wood", "glass"};
  glass.base_colours.resize(2);
  glass.channels.resize(2);
  glass.channels[1].alpha_mode = AlphaMode::Blend;
  glass.set_face_property(
      {"material", ScalarType::Int32, std::vector<double>(glass.mesh.face_count(), 0)});
  CHECK(shown_textures(glass, "ball.obj").warning.empty());  // no face is of it
  glass.face_properties.back().values[3] = 1;
  CHECK_THAT(shown_textures(glass, "ball.obj").warning,
             Contains("ball.obj: shown opaque") && Contains("'glass'"));
  CHECK(none.textures->of_materials.empty());

  MeshFile broken = ball(true);
  broken.materials = {"skin"};
  broken.base_colours = {{.image = "skin.png", .problem = "it is not there"}};
  const ShownTextures without = shown_textures(broken, "ball.glb");
  CHECK_THAT(without.warning, Contains("skin.png: it is not there: shown without"));
  CHECK(without.textures->of_materials.empty());
  CHECK_FALSE(without.left_behind);

  MeshFile bare = ball(false);
  bare.materials = {"skin"};
  bare.base_colours = {{.image = "skin.png"}};
  CHECK_THAT(shown_textures(bare, "ball.glb").warning, Contains("no texture coordinates"));

  MeshFile copied = ball(true);
  copied.comments = {"base colour of skin: skin.png"};
  const ShownTextures left = shown_textures(copied, "ball.sph.ply");
  CHECK(left.left_behind);
  CHECK_THAT(left.warning, Contains("not in this file (base colour of skin: skin.png)"));
  copied.comments = {"TextureFile skin.png"};
  CHECK_THAT(shown_textures(copied, "ball.sph.ply").warning,
             Contains("not in this file (TextureFile skin.png)"));
}
