#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "image/image_codec.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/texture/equirectangular_image.h"
#include "support/direction_image.h"
#include "support/folder.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double pi = std::numbers::pi;

Vector3 looked_up(const EquirectangularImage& image, const Vector3& direction, double width) {
  const std::array<float, 4> colour = image.look_up(direction, width);
  return Eigen::Vector3f(colour.data()).cast<double>();
}

std::vector<Vector3> some_directions() {
  // The poles, the seam, their neighbourhood, and anywhere.
  std::vector<Vector3> directions = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}};
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 300; ++i) {
    const Vector3 offset(normal(random), normal(random), normal(random));
    directions.push_back(offset);
    directions.push_back(Vector3(0, 0, i % 2 ? 1 : -1) + 0.02 * offset);
    directions.push_back(Vector3(1, 0.01 * offset.y(), offset.z()));
  }
  return directions;
}

}  // namespace

TEST_CASE("equirectangular: an image of directions gives the direction back, at poles and seam") {
  for (const int width : {64, 256}) {
    const TexturePyramid pyramid(direction_image(width), true);
    const EquirectangularImage image(pyramid, Convention::Sphparam);
    const double texel = 2 * pi / width;
    for (const Vector3& direction : some_directions()) {
      const Vector3 expected = Vector3::Constant(0.5) + 0.5 * direction.normalized();
      INFO(direction.transpose());
      CHECK((looked_up(image, direction, 0) - expected).norm() < 0.2 * texel * texel + 1e-4);
      // A wide look is a mean: a sphere's cap points the same way, a little shorter. About a pole
      // it is of whole rows.
      const double width_of_look = 4 * texel;
      const bool at_pole = direction.normalized().head<2>().norm() < width_of_look;
      CHECK((looked_up(image, direction, width_of_look) - expected).norm() <
            (at_pole ? 0.1 * width_of_look : 0.25 * width_of_look * width_of_look));
    }
  }
}

TEST_CASE("equirectangular: a constant image is constant, however wide the look") {
  for (const int width : {2, 14, 100}) {
    const TexturePyramid pyramid(uniform_image(width, 0.25F), true);
    const EquirectangularImage image(pyramid, Convention::Three);
    for (const double look : {0.0, 1e-3, 0.1, 1.0, 7.0}) {
      for (const Vector3& direction : some_directions()) {
        CHECK((looked_up(image, direction, look).array() - 0.25).abs().maxCoeff() < 1e-4);
      }
    }
  }
}

TEST_CASE("equirectangular: means are by area, where rows near the poles count less") {
  Image cap(64, 32, 3);  // white to 45° from the pole
  std::fill_n(cap.pixels.begin(), 3 * 64 * 8, 1.0F);
  const TexturePyramid pyramid(cap, true, 1, {}, ImageRows::Parallels);
  const EquirectangularImage image(pyramid, Convention::Sphparam);
  const double all = (1 - std::cos(pi / 4)) / 2;  // 0.1464, of 0.25 of the rows
  CHECK(looked_up(image, {1, 0, 0}, 10)[0] == Approx(all).margin(2e-5));
  Image row(64, 32, 3);  // white in the first row, 5.625° wide
  std::fill_n(row.pixels.begin(), 3 * 64, 1.0F);
  const TexturePyramid rows(row, true, 1, {}, ImageRows::Parallels);
  const double share = (1 - std::cos(pi / 32)) / (1 - std::cos(pi / 16));  // 0.2506
  CHECK(looked_up(EquirectangularImage(rows, Convention::Sphparam), {0, 0, 1}, pi / 16)[0] ==
        Approx(share).margin(2e-5));
}

TEST_CASE("equirectangular: floats are linear light in any format, integers sRGB") {
  const Folder folder;
  Image grey(4, 2, 3);
  std::fill(grey.pixels.begin(), grey.pixels.end(), 0.25F);
  const auto value = [&](ImageFormat format, SampleType type, const std::string& name,
                         std::string* warning = nullptr) {
    const std::vector<char> bytes = encode_image(grey, format, {.sample_type = type});
    write_file(folder / name, {bytes.data(), bytes.size()});
    const EquirectangularImage image = read_equirectangular(folder / name);
    if (warning) *warning = image.warning();
    return looked_up(image, {1, 0, 0}, 0)[0];
  };
  std::string of_tiff, of_exr;
  CHECK(value(ImageFormat::Tiff, SampleType::Float, "f.tif", &of_tiff) ==
        Approx(0.25).margin(2e-5));
  CHECK(value(ImageFormat::Exr, SampleType::Half, "h.exr", &of_exr) == Approx(0.25).margin(2e-5));
  CHECK_THAT(of_tiff, Catch::Contains("its colours are floats, which are taken as linear light"));
  CHECK(of_exr.empty());
  // 64/255 of bytes: ((0.25098 + 0.055) / 1.055)^2.4
  CHECK(value(ImageFormat::Tiff, SampleType::Uint8, "u.tif") == Approx(0.05127).margin(2e-5));
}

TEST_CASE("equirectangular: greys of 16 bits that end far below white are refused") {
  const Folder folder;
  Image heights(4, 2, 1);
  const auto read = [&](float greatest) {
    heights.pixels[3] = greatest;
    write_image(folder / "dem.png", heights, {.sample_type = SampleType::Uint16});
    return read_equirectangular(folder / "dem.png");
  };
  CHECK_THROWS_WITH(read(2000 / 65535.0F), Catch::Contains("a vertex would have one of 9") &&
                                               Catch::Contains("-scale 0 2000 0 65535"));
  CHECK_NOTHROW(read(0.25F));
  CHECK_NOTHROW(read(0));
}

TEST_CASE("equirectangular: an image of nodes is told") {
  CHECK_THAT(warning_of_shape("a.png", 361, 181),
             Catch::Contains("resample the image to 360 × 180"));
  for (const auto& [width, height] : {std::pair(360, 180), std::pair(361, 180), std::pair(2, 1)})
    CHECK(warning_of_shape("a.png", width, height).empty());
}

TEST_CASE("equirectangular: conventions put longitude where their viewers have it") {
  Image stripe(64, 32, 3);  // white about u = 1/4
  for (int y = 0; y < 32; ++y) {
    for (int x = 14; x < 18; ++x) std::fill_n(stripe.pixel(x, y), 3, 1.0F);
  }
  const TexturePyramid pyramid(stripe);
  const auto at = [&](Convention convention, const Vector3& direction) {
    return looked_up(EquirectangularImage(pyramid, convention), direction, 0).x();
  };
  // u of +x, +y, −x, −y is 0 ¼ ½ ¾; GIS ½ ¾ 0 ¼; blender ½ − u; envmap ¼ − u.
  CHECK(at(Convention::Sphparam, {0, 1, 0}) > 0.99);
  CHECK(at(Convention::Sphparam, {0, -1, 0}) < 0.01);
  CHECK(at(Convention::Gis, {0, -1, 0}) > 0.99);
  CHECK(at(Convention::Blender, {0, 1, 0}) > 0.99);
  CHECK(at(Convention::Envmap, {1, 0, 0}) > 0.99);
}

TEST_CASE("equirectangular: nothing aliases: one texel of a row at the pole weighs what it is") {
  constexpr int width = 512;
  Image image(width, width / 2, 3);
  std::fill_n(image.pixel(137, 0), 3, 1.0F);  // next to the pole, 1 of 512 texels of its row
  const TexturePyramid pyramid(image, true);
  const EquirectangularImage look(pyramid, Convention::Sphparam);
  const Vector3 there = to_cartesian({2 * pi * 137.5 / width, pi * 0.5 / 256});
  CHECK(looked_up(look, there, 1e-6).x() > 0.9);
  CHECK(looked_up(look, there, pi / 256).x() < 0.02);
  CHECK(looked_up(look, {0, 0, 1}, pi / 256).x() < 0.02);
}

TEST_CASE("equirectangular: numbers that are measured are no colours, light may be bright") {
  const Folder folder;
  const std::string path = folder / "heights.exr";
  Image image(8, 4, 3);
  const auto refused = [&](size_t bright) {
    for (size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i] = i / 3 < bright ? 25.0F : 0.5F;
    write_image(path, image, {.sample_type = SampleType::Float});
    try {
      read_equirectangular(path);
      return std::string();
    } catch (const ImageError& error) {
      return std::string(error.what());
    }
  };
  CHECK(refused(0).empty());
  CHECK(read_equirectangular(path).warning().empty());
  CHECK(refused(16).empty());
  CHECK(read_equirectangular(path).warning() ==
        display_name(path) +
            ": 50 % of its pixels have values outside of 0 to 1, which are cut to that");
  CHECK_THAT(refused(17), Catch::Contains("no colours: 53.1 % of its pixels"));
  // Of other formats than EXR one in a hundred: TIFF has floats too.
  const std::string tiff = folder / "heights.tif";
  const std::vector<char> bytes =
      encode_image(image, ImageFormat::Tiff, {.sample_type = SampleType::Float});
  write_file(tiff, {bytes.begin(), bytes.end()});
  CHECK_THROWS_AS(read_equirectangular(tiff), ImageError);
}

TEST_CASE("equirectangular: heights that were baked in floats are told, whatever their range") {
  const Folder folder;
  const std::string path = folder / "baked.exr";
  Image image(8, 4, 1);
  std::fill(image.pixels.begin(), image.pixels.end(), 0.5F);
  const auto warning_of = [&](ImageTexts texts) {
    write_image(path, image, {.sample_type = SampleType::Float, .metadata = std::move(texts)});
    return read_equirectangular(path).warning();
  };
  const std::pair<std::string, std::string> height{"sphparam:map", "height"},
      about{"sphparam:about", "distance from the origin"}, least{"sphparam:min", "0"};
  CHECK(warning_of({height, about}) ==
        display_name(path) +
            ": its pixels are what was measured (distance from the origin), and "
            "taken as colours; a PNG of it is scaled from dark to bright");
  CHECK(warning_of({{"sphparam:map", "curvature:mean"}, about}).size() > 50);
  CHECK(warning_of({height, about, least}).empty());
  CHECK(warning_of({{"sphparam:map", "ao"}, about}).empty());
  CHECK(warning_of({{"sphparam:map", "basecolor"}}).empty());
  CHECK(warning_of({}).empty());
}

TEST_CASE("equirectangular: a colour profile that is not sRGB's is told") {
  const Folder folder;
  const std::string path = folder / "profile.jpg";
  const std::vector<char> jpeg = encode_image(Image(8, 4, 3), ImageFormat::Jpeg);
  std::string bytes(jpeg.begin(), jpeg.end());
  write_file(path, bytes);
  CHECK(read_equirectangular(path).warning().empty());
  const std::string profile = std::string("ICC_PROFILE\0\x01\x01", 14) + std::string(200, 'x');
  bytes.insert(2, "\xff\xe2" + std::string{'\0', static_cast<char>(profile.size() + 2)} + profile);
  write_file(path, bytes);
  CHECK(read_equirectangular(path).warning() ==
        display_name(path) +
            ": its colours are taken as sRGB; its colour profile, without a name, "
            "is not heeded (convert the image to sRGB)");
}

TEST_CASE("equirectangular: an image that is not twice as wide as high is told, but for a texel") {
  CHECK(warning_of_shape("earth.png", 64, 32).empty());
  CHECK(warning_of_shape("earth.png", 65, 32).empty());
  CHECK(
      warning_of_shape("earth.png", 66, 32) ==
      "earth.png: 66 × 32: an equirectangular image of the whole sphere is twice as wide as high");
  CHECK_FALSE(warning_of_shape("earth.png", 32, 32).empty());
}
