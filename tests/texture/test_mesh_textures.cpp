#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "image/image_codec.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/texture/mesh_textures.h"
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

std::string green_png() {
  Image image(2, 2, 3);
  for (size_t i = 1; i < image.pixels.size(); i += 3) image.pixels[i] = 1;
  const std::vector<char> bytes = encode_image(image, ImageFormat::Png);
  const std::string path = std::filesystem::temp_directory_path() /
                           ("sphparam_green_" + std::to_string(getpid()) + ".png");
  write_file(path, {bytes.begin(), bytes.end()});
  return path;
}

}  // namespace

TEST_CASE("shown textures: an image that is named is on all of the mesh, where it has a place") {
  const std::string image = green_png();
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
}
