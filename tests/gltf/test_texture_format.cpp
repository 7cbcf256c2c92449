#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "charted.h"
#include "gltf/images/texture_format.h"
#include "gltf/images/variant_images.h"
#include "image/image_codec.h"
#include "image/webp.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/gltf/texture_format.h"
#include "sphparam/io/mesh_reader.h"
#include "support/glb_json.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Waves that are no multiples of anything, each channel its own.
Image waves(int channels, int width = 128) {
  Image image(width, width / 2, channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.pixel(x, y)[c] = static_cast<float>(
            0.5 + 0.3 * std::sin(0.7 * x + 0.01 * x * y * (c + 1)) + 0.1 * std::cos(1.3 * y));
  return image;
}

Image decoded(const AssetImage& image) {
  return decode_image({image.bytes.begin(), image.bytes.end()}, image.name);
}

std::string text(const std::vector<char>& bytes) { return {bytes.begin(), bytes.end()}; }

/// Base colour with alpha, normals, and an image for roughness; emission without alpha.
Look painted() {
  Look look;
  look.images = {as_png("basecolor", waves(4)), as_png("normal", waves(3)),
                 as_png("orm", waves(3, 64)), as_png("emissive", waves(3, 96))};
  look.materials = {{.name = "m",
                     .base_colour = 0,
                     .normal = 1,
                     .occlusion = 2,
                     .metallic_roughness = 2,
                     .emissive = 3}};
  return look;
}

Look encoded(Look look, TextureFormat format, int threads = 1) {
  encode_textures(look, {.textures = format, .webp_quality = 70}, threads);
  return look;
}

std::vector<std::string> kinds(const Look& look) {
  std::vector<std::string> kinds;
  for (const TextureFigures& texture : look.textures) kinds.emplace_back(texture.kind);
  return kinds;
}

double alpha_difference(const Image& a, const Image& b) {
  double most = 0;
  for (std::size_t i = 3; i < a.pixels.size(); i += 4)
    most = std::max(most, double{std::abs(a.pixels[i] - b.pixels[i])});
  return most;
}

}  // namespace

TEST_CASE("texture format: webp loses of colours, nothing of alpha, normals and roughness") {
  const Look given = painted(), made = encoded(given, TextureFormat::Webp);
  CHECK(kinds(made) == std::vector<std::string>(4, "webp"));
  for (const std::size_t i : {0U, 3U}) CHECK_FALSE(made.textures[i].exact);
  for (const std::size_t i : {1U, 2U}) {
    CHECK(made.textures[i].exact);
    CHECK((decoded(made.images[i]).pixels == decoded(given.images[i]).pixels));
  }
  CHECK(alpha_difference(decoded(made.images[0]), decoded(given.images[0])) == 0);
  CHECK((decoded(made.images[0]).pixels != decoded(given.images[0]).pixels));
  CHECK(made.warnings.empty());
}

TEST_CASE("texture format: webp-lossless has every number of every image") {
  const Look given = painted(), made = encoded(given, TextureFormat::WebpLossless);
  CHECK(kinds(made) == std::vector<std::string>(4, "webp"));
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(made.textures[i].exact);
    CHECK(made.textures[i].bytes == made.images[i].bytes.size());
    CHECK(made.textures[i].given_bytes == given.images[i].bytes.size());
    CHECK((decoded(made.images[i]).pixels == decoded(given.images[i]).pixels));
  }
}

TEST_CASE("texture format: an image that is seen as a colour and as data loses nothing") {
  Look look = painted();
  look.materials.push_back({.name = "orm", .base_colour = 2, .unlit = true});
  CHECK(encoded(look, TextureFormat::Webp).textures[2].exact);
}

TEST_CASE("texture format: of few colours, webp without loss is the smaller one") {
  Look look;
  look.images = {test_asset_image(TestImage::Checker, 256, Convention::Sphparam)};
  look.materials = {{.name = "m", .base_colour = 0}};
  const Look made = encoded(look, TextureFormat::Webp);
  CHECK(made.textures[0].exact);
  CHECK((decoded(made.images[0]).pixels == decoded(look.images[0]).pixels));
}

TEST_CASE("texture format: jpeg takes colours without alpha, png what is not, given keeps both") {
  const Look given = painted(), jpeg = encoded(given, TextureFormat::Jpeg);
  CHECK(kinds(jpeg) == std::vector<std::string>{"png", "png", "png", "jpeg"});
  Look opaque = given;
  opaque.images[0] = as_png("basecolor", [] {
    Image image = waves(4);
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 1;
    return image;
  }());
  CHECK(kinds(encoded(opaque, TextureFormat::Jpeg))[0] == "jpeg");
  CHECK(encoded(jpeg, TextureFormat::Given).images[3].bytes == jpeg.images[3].bytes);
  const Look png = encoded(jpeg, TextureFormat::Png);
  CHECK(kinds(png) == std::vector<std::string>(4, "png"));
  CHECK((decoded(png.images[3]).pixels == decoded(jpeg.images[3]).pixels));
  CHECK(png.textures[3].exact);
}

TEST_CASE("texture format: WebP that is given stays where webp is wanted, and else becomes PNG") {
  const Look webp = encoded(painted(), TextureFormat::Webp);
  for (const TextureFormat format : {TextureFormat::Webp, TextureFormat::WebpLossless})
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(encoded(webp, format).images[i].bytes == webp.images[i].bytes);
  for (const TextureFormat format : {TextureFormat::Given, TextureFormat::Png}) {
    const Look png = encoded(webp, format);
    CHECK(kinds(png) == std::vector<std::string>(4, "png"));
    CHECK((decoded(png.images[0]).pixels == decoded(webp.images[0]).pixels));
  }
  const Look jpeg = encoded(webp, TextureFormat::Jpeg);  // colours without alpha
  CHECK(kinds(jpeg) == std::vector<std::string>{"png", "png", "png", "jpeg"});
  CHECK_FALSE(jpeg.textures[3].exact);
}

TEST_CASE("texture format: 16 bits that become 8 are told, and what WebP has no room for") {
  Look look = painted();
  look.images[1].bytes =
      text(encode_image(waves(3), ImageFormat::Png, {.sample_type = SampleType::Uint16}));
  const Look made = encoded(look, TextureFormat::Webp);
  REQUIRE(made.warnings.size() == 1);
  CHECK(made.warnings[0] ==
        "normal: 16 bits a channel become 8, which is all that webp images have");
  Image wide(most_webp_side + 1, 1, 3);
  for (std::size_t i = 0; i < wide.pixels.size(); ++i)
    wide.pixels[i] = static_cast<float>(i * i % 256) / 255;
  look.images[1] = as_png("normal", wide);
  const Look kept = encoded(look, TextureFormat::WebpLossless);
  CHECK(kept.images[1].bytes == look.images[1].bytes);
  REQUIRE(kept.warnings.size() == 1);
  CHECK(kept.warnings[0] == "normal: stays png, for WebP has at most 16383 texels a side");
}

TEST_CASE("texture format: a .glb of WebP says that it needs its extension, and is read back") {
  const Look look = encoded(painted(), TextureFormat::WebpLossless);
  Asset asset = Charted({}, 2).asset();
  asset.images = look.images;
  asset.materials = look.materials;
  asset.images.push_back(as_png("white", waves(3, 64)));
  const std::string glb = glb_bytes(asset);
  const nlohmann::json gltf = json_of(glb);
  CHECK(gltf["extensionsUsed"] == nlohmann::json({"EXT_texture_webp"}));
  CHECK(gltf["extensionsRequired"] == nlohmann::json({"EXT_texture_webp"}));
  CHECK(gltf["images"][1]["mimeType"] == "image/webp");
  CHECK(gltf["textures"][1]["extensions"]["EXT_texture_webp"]["source"] == 1);
  CHECK_FALSE(gltf["textures"][1].contains("source"));
  CHECK(gltf["textures"][4]["source"] == 4);
  const MeshFile file = read_mesh(std::string_view(glb), "ball.glb", ReadOptions{});
  REQUIRE(file.base_colours.size() == 1);
  const std::vector<char>& bytes = *file.base_colours[0].bytes;
  CHECK((decode_image(bytes, "b").pixels == decoded(painted().images[0]).pixels));
}

TEST_CASE("texture format: the same bytes for any number of threads, words for people") {
  const Look one = encoded(painted(), TextureFormat::Webp, 1),
             four = encoded(painted(), TextureFormat::Webp, 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(one.images[i].bytes == four.images[i].bytes);
  CHECK(words_of({{"a", "webp", 3'000'000, 1'000'000, false},
                  {"b", "webp", 2'000'000, 1'500'000, true},
                  {"c", "png", 100'000, 100'000, true}}) ==
        "3 images of 2.6 MB in all, 5.1 MB as given: 1 png, 1 webp, 1 webp with loss");
}
