#include <unistd.h>

#include <catch2/catch.hpp>
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
