#include "sphparam/texture/equirectangular_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary.h"
#include "image/image_codec.h"
#include "number_text.h"
#include "sphparam/io/paths.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "texture/baked_texts.h"
#include "texture/read_textures.h"
#include "texture/texture_pyramid.h"

namespace sphparam {
namespace {

using Level = TexturePyramid::Level;
using Colour = Eigen::Array4f;

constexpr double pi = std::numbers::pi;

/// A texel of row −1 or `height`, beyond a pole, is one of the last row, half a turn away.
Colour bilinear_in_row(const Level& level, int row, double u) {
  if (row < 0 || row >= level.height) {
    row = row < 0 ? -1 - row : 2 * level.height - 1 - row;
    u += 0.5;
  }
  row = std::clamp(row, 0, level.height - 1);
  const double x = (u - std::floor(u)) * level.width - 0.5;
  const double left = std::floor(x);
  const auto share = static_cast<float>(x - left);
  const auto column = [&](int i) { return (i + level.width) % level.width; };
  const auto texel = [&](int i) -> Colour {
    const size_t index = static_cast<size_t>(row) * static_cast<size_t>(level.width) +
                         static_cast<size_t>(column(i));
    return Eigen::Map<const Eigen::Array<std::uint16_t, 4, 1>>(&level.texels[4 * index])
        .cast<float>();
  };
  const int first = static_cast<int>(left);
  const Colour at = texel(first);
  return at + share * (texel(first + 1) - at);
}

Colour bilinear(const Level& level, double u, double v) {
  const double y = v * level.height - 0.5, above = std::floor(y);
  const auto share = static_cast<float>(y - above);
  const int row = static_cast<int>(above);
  const Colour at = bilinear_in_row(level, row, u);
  return at + share * (bilinear_in_row(level, row + 1, u) - at);
}

/// The mean over `turns` of longitude about u.
Colour mean_along(const Level& level, double u, double v, double turns) {
  const int samples = std::clamp(static_cast<int>(turns * level.width + 0.5), 1, level.width);
  Colour sum = Colour::Zero();
  for (int i = 0; i < samples; ++i) {
    sum += bilinear(level, u + turns * ((i + 0.5) / samples - 0.5), v);
  }
  return sum / static_cast<float>(samples);
}

/// Of the pixels, those with a value that is no colour.
double share_beyond_colours(const Image& image) {
  const auto beyond = [](float x) { return !(-0.01F < x && x < 1.01F); };  // filters overshoot
  const auto channels = static_cast<size_t>(image.channels);
  long count = 0;
  for (size_t i = 0; i < image.pixels.size(); i += channels)
    count += std::any_of(&image.pixels[i], &image.pixels[i] + channels, beyond);
  return static_cast<double>(count) / (static_cast<double>(image.width) * image.height);
}

/// Heights in metres, say, would all be white or black. Light may be brighter than white: in words,
/// how much of it is; empty: nothing. Throws: ImageError where that is too much.
std::string words_of_light(const std::string& path, const Image& image) {
  const bool is_light = image_format_of(path) == ImageFormat::Exr;
  const double most = is_light ? 0.5 : 0.01, share = share_beyond_colours(image);
  if (share == 0) return "";
  if (share <= most)
    return percent(share) + " of its pixels have values outside of 0 to 1, which are cut to that";
  throw ImageError(display_name(path) + ": no colours: " + percent(share) +
                   " of its pixels have values outside of 0 to 1; numbers that are measured are "
                   "scaled to that before they are painted");
}

/// Of an image of one channel, more than 8 bits of which the brightest values are not used: heights
/// in metres, say, would be a few greys. Throws ImageError.
void require_greys(const std::string& path, const Image& image, const ImageTexts& texts) {
  const std::string_view samples = baked_text(texts, samples_text);
  const bool is_fine = samples.starts_with("uint") && samples != "uint8";
  if (!is_fine || image.channels > 2 || !baked_text(texts, "sphparam:map").empty()) return;
  constexpr float least = 0.25F;
  constexpr double steps = 65535;
  float greatest = 0;
  for (size_t i = 0; i < image.pixels.size(); i += static_cast<size_t>(image.channels))
    greatest = std::max(greatest, image.pixels[i]);
  if (greatest == 0 || greatest >= least) return;
  const std::string name = display_name(path);
  const std::string top =
      samples == "uint16" ? shortest(std::round(steps * static_cast<double>(greatest))) : "MAX";
  throw ImageError(name + ": no colours: its greys end at " + percent(greatest) +
                   " of white, as numbers that are measured do, and a vertex would have one of " +
                   std::to_string(std::lround(255 * greatest) + 1) +
                   "; scale them first (gdal_translate -ot UInt16 -scale 0 " + top + " 0 65535 " +
                   name + " scaled.tif)");
}

}  // namespace

std::array<float, 4> EquirectangularImage::look_up(const Vector3& direction, double width) const {
  const SphericalCoordinates place = to_spherical(direction);
  const double u = convention_.turns * place.theta / (2 * pi) + convention_.offset;
  const double v = place.phi / pi;
  const double radius = elementary::sin(place.phi);
  const double turns = std::min(1.0, width / (2 * pi * std::max(radius, width / (2 * pi))));

  const auto& levels = pyramid_->levels();
  const double texels = width / pi * levels.front().height;
  const double depth = std::clamp(elementary::log2(std::max(texels, 1.0)), 0.0,
                                  static_cast<double>(levels.size() - 1));
  const auto fine = static_cast<size_t>(depth);
  const auto share = static_cast<float>(depth - static_cast<double>(fine));
  Colour colour = mean_along(levels[fine], u, v, turns);
  if (share > 0) colour += share * (mean_along(levels[fine + 1], u, v, turns) - colour);
  colour /= 65535;
  return {colour[0], colour[1], colour[2], colour[3]};
}

int EquirectangularImage::width() const { return pyramid_->levels().front().width; }
int EquirectangularImage::height() const { return pyramid_->levels().front().height; }
bool EquirectangularImage::has_alpha() const { return pyramid_->has_alpha(); }

std::string warning_of_shape(const std::string& path, int width, int height) {
  const std::string size =
      display_name(path) + ": " + std::to_string(width) + " × " + std::to_string(height);
  // No image of `bake`, which rounds half an odd width down.
  if (width == 2 * height - 1)
    return size +
           ": numbers at nodes have a row for each pole and the first column twice; they are taken "
           "as texels, up to half a texel from where they stand (resample the image to " +
           std::to_string(width - 1) + " × " + std::to_string(height - 1) + ")";
  if (std::abs(width - 2 * height) <= 1) return "";
  return size + ": an equirectangular image of the whole sphere is twice as wide as high";
}

EquirectangularImage read_equirectangular(const std::string& path, Convention convention,
                                          int threads) {
  ImageTexts texts;
  const Image image = read_image(path, {}, &texts);
  const bool linear = has_float_samples(texts);
  if (const auto baked = baked_convention_of(texts); baked && *baked != convention) {
    const std::string name = info_of(*baked).name;
    throw ImageOfOtherConvention(display_name(path) + " is baked in the convention " + name +
                                 ", and would be read in " + info_of(convention).name +
                                 ": convention " + name + " reads it as it is");
  }
  require_greys(path, image, texts);
  const std::string light = words_of_light(path, image);
  return {std::make_shared<const TexturePyramid>(image, linear, threads, SeenTexels(),
                                                 ImageRows::Parallels),
          convention, file_warning(display_name(path), texts, TexelKind::Colour, light),
          std::string(baked_text(texts, rays_text))};
}

}  // namespace sphparam
