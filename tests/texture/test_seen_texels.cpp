#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "texture/seen_by_mesh.h"
#include "texture/seen_texels.h"
#include "texture/texture_pyramid.h"
#include "texture/texture_seams.h"

using namespace sphparam;

namespace {

/// A row of letters a row of texels: # inside, + touched, . unseen.
std::vector<std::string> picture(const SeenTexels& seen, size_t width, size_t height) {
  std::vector<std::string> rows(height);
  for (size_t y = 0; y < height; ++y) {
    for (size_t x = 0; x < width; ++x) {
      const float weight = seen.weight(y * width + x);
      rows[y] += weight == 1 ? '#' : weight > 0 ? '+' : '.';
    }
  }
  return rows;
}

using Rows = std::vector<std::string>;

/// Two faces that share an edge, looking at a square of the image.
MeshFile square(double size) {
  MeshFile file;
  file.mesh.positions.resize(4, 3);
  file.mesh.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  file.mesh.triangles.resize(2, 3);
  file.mesh.triangles << 0, 1, 2, 0, 2, 3;
  file.corner_texcoords.emplace(6, 2);
  *file.corner_texcoords << 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1;
  *file.corner_texcoords *= size;
  return file;
}

/// Red in the left half, blue in the right one.
Image halves(int size) {
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) image.pixel(x, y)[2 * x < size ? 0 : 2] = 1;
  return image;
}

}  // namespace

TEST_CASE(
    "seen texels: those with their middle in a triangle, and those that bilinear look-ups touch") {
  SeenTexels clamped(6, 5), repeated(6, 5), mirrored(6, 5);
  const SeenTexels::Corners corners{{{0, 0}, {2, 0}, {0, 2}}};
  clamped.add(corners, TextureWrap::Clamp, TextureWrap::Clamp);
  repeated.add(corners, TextureWrap::Repeat, TextureWrap::Repeat);
  mirrored.add(corners, TextureWrap::Mirror, TextureWrap::Mirror);
  CHECK(picture(clamped, 6, 5) == Rows{"##+...", "#++...", "++....", "......", "......"});
  CHECK(picture(repeated, 6, 5) == Rows{"##+..+", "#++..+", "++...+", "......", "+++..+"});
  CHECK(picture(mirrored, 6, 5) == picture(clamped, 6, 5));
  CHECK(SeenTexels().all());
  CHECK(SeenTexels().weight(7) == 1);
}

TEST_CASE("seen texels: a triangle without area is touched, not inside") {
  SeenTexels seen(4, 3);
  seen.add({{{1.2, 1.2}, {1.2, 1.2}, {1.2, 1.2}}}, TextureWrap::Clamp, TextureWrap::Clamp);
  CHECK(picture(seen, 4, 3) == Rows{"++..", "++..", "...."});
}

TEST_CASE(
    "seen texels: of a mesh, by its own coordinates, all where many images are tiled, or none "
    "are") {
  MeshFile file = square(0.5);
  CHECK(picture(seen_texels(file, TextureWrap::Clamp, 4, 4, 1), 4, 4) ==
        Rows{"....", "+++.", "##+.", "##+."});  // t upwards
  CHECK(seen_texels(square(3), TextureWrap::Repeat, 4, 4, 1).all());
  file.corner_texcoords.reset();
  CHECK(seen_texels(file, TextureWrap::Repeat, 4, 4, 1).all());
}

TEST_CASE(
    "seen texels: an image of some materials is seen by their faces alone, where these place it") {
  MeshFile file = square(1);
  file.materials = {"one", "two"};
  file.set_face_property({"material", ScalarType::Int32, {0, 1}});
  MaterialTexture image{.image = "a.png", .folder = ".", .path = "a.png"};
  image.wrap_s = image.wrap_t = Wrapping::Clamp;
  image.placement = {{{0.5, 0, 0}, {0, 0.5, 0}}};
  file.base_colours = {MaterialTexture{}, image};
  CHECK(picture(seen_texels(file, origin_of(image), 4, 4, 1), 4, 4) ==
        Rows{"....", "+++.", "##+.", "#++."});
  file.channels.resize(2);
  file.channels[0].roughness = image;  // the other face looks there as well
  CHECK(picture(seen_texels(file, origin_of(image), 4, 4, 1), 4, 4) ==
        Rows{"....", "+++.", "##+.", "##+."});
}

TEST_CASE("pyramid: means are of what is seen, and what nobody sees takes the colour beside it") {
  SeenTexels left(8, 8);
  left.add({{{0, 0}, {0, 8}, {3, 0}}}, TextureWrap::Clamp, TextureWrap::Clamp);
  left.add({{{3, 0}, {0, 8}, {3, 8}}}, TextureWrap::Clamp, TextureWrap::Clamp);
  const TexturePyramid pyramid(halves(8), true, 1, left);
  for (size_t l = 1; l < pyramid.levels().size(); ++l) {
    const TexturePyramid::Level& level = pyramid.levels()[l];
    CHECK(level.texels[0] == 65535);  // its first column, and the right one, which nobody sees
    CHECK(level.texels[2] == 0);
    CHECK(level.texels[static_cast<size_t>(4 * (level.width - 1))] == 65535);
  }
  const std::vector<std::uint16_t>& finest = pyramid.levels()[0].texels;
  CHECK(finest[static_cast<size_t>(4 * 4)] == 65535);
  CHECK(finest[static_cast<size_t>(4 * 4 + 2)] == 0);
}

TEST_CASE("pyramid: where all is seen, its bytes are those of a pyramid that knows nothing") {
  SeenTexels all(7, 5);
  all.add({{{-9, -9}, {30, -9}, {-9, 30}}}, TextureWrap::Clamp, TextureWrap::Clamp);
  Image image(7, 5, 3);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(i * 37 % 101) / 100;
  const TexturePyramid one(image, false, 1), other(image, false, 1, all);
  for (size_t l = 0; l < one.levels().size(); ++l)
    CHECK(one.levels()[l].texels == other.levels()[l].texels);
}

TEST_CASE("texture seams: edges whose faces do not agree on their ends, or on the material") {
  const MeshFile file = square(1);
  CornerTexcoords apart = *file.corner_texcoords;
  CHECK(seamed(file.mesh.triangles, apart, nullptr).seams == std::vector<std::uint8_t>{5, 3});
  const Property one{"material", ScalarType::Int32, {0, 0}},
      two{"material", ScalarType::Int32, {0, 1}};
  CHECK(seamed(file.mesh.triangles, apart, &one).seams == std::vector<std::uint8_t>{5, 3});
  CHECK(seamed(file.mesh.triangles, apart, &two).seams == std::vector<std::uint8_t>{7, 7});
  apart(4, 0) += 1e-3;
  CHECK(seamed(file.mesh.triangles, apart, nullptr).seams == std::vector<std::uint8_t>{7, 7});
  apart(4, 0) -= 1e-3;
  apart.topRows(3).col(1).array() += 2;
  CHECK(seamed(file.mesh.triangles, apart, nullptr).seams ==
        std::vector<std::uint8_t>{5 + (2 << 3), 3 + (4 << 3)});
  apart(0, 0) += 1;  // the images of one end are others
  CHECK(seamed(file.mesh.triangles, apart, nullptr).seams == std::vector<std::uint8_t>{7, 7});
  CHECK(seamed(file.mesh.triangles, {}, nullptr).seams.empty());
}

TEST_CASE(
    "sampling: what lies beyond a seam is in no sample, however much of the image one covers") {
  const SourceTexture texture{.image = std::make_shared<const TexturePyramid>(halves(64), true, 1)};
  TextureLine line{{0.25, 0.25}, {0.08, 0}, {0, 0.08}, 4};
  // The face has its right side, which faces corner 0, between the halves.
  line.face = {1, {{0, 0}, {0.5, 0}, {0.5, 1}}, {0.5, 0.25, 0.25}, {-0.16, 0.16, 0}};
  std::vector<float> rgb(12);
  sample_texture(texture, TextureFilter::Bilinear, line, rgb.data(), 3);
  for (size_t i = 0; i < 4; ++i) {
    CHECK(rgb[3 * i] == 1);
    CHECK(rgb[3 * i + 2] == 0);
  }
  line.face.seams = 0;
  sample_texture(texture, TextureFilter::Bilinear, line, rgb.data(), 3);
  CHECK(rgb[9] < 1);  // half a texel from the right half, of samples 5 wide
  CHECK(rgb[0] == 1);
  const std::vector<float> across = rgb;
  line.face.seams = 1 << 3;  // an image that repeats goes on
  sample_texture(texture, TextureFilter::Bilinear, line, rgb.data(), 3);
  CHECK(rgb == across);
  SourceTexture once = texture, half = texture;
  once.wrap_s = TextureWrap::Clamp;
  half.placement[0][0] = 0.5;
  for (const SourceTexture& other : {once, half}) {
    sample_texture(other, TextureFilter::Bilinear, line, rgb.data(), 3);
    CHECK(rgb[9] == 1);
  }
}
