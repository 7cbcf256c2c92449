// 16 bits: value = round(65535 (h − min) / (max − min)) / 65535, so scale = max − min and
// midlevel = −min / (max − min).

#include "displace/displacement_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "number_text.h"
#include "remesh/image_file.h"

namespace sphparam {

namespace {

constexpr double most_half = 65504, least_half = 0x1p-17;  // 128 steps are left
constexpr char about[] =
    "signed distance from the limit surface's point with the direction to the mesh, along the "
    "limit surface's unit normal";
constexpr char recipe[] =
    "subdivide the control mesh by its scheme to the limit surface, its texture coordinates "
    "straight over each face (not smoothed); displace along normals by (value - midlevel) * scale";

double number_of(const ImageTexts& texts, const std::string& key, const std::string& file) {
  for (const auto& [name, text] : texts) {
    double value = 0;
    if (name == key &&
        std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc{} &&
        std::isfinite(value)) {
      return value;
    }
  }
  throw ImageError(file + ": no displacement: its metadata " + key + " is no number");
}

/// The image in memory is of floats; half has fewer numbers still. Below the least one of full
/// precision steps become coarse.
void require_representable(double largest, ImageDepth depth) {
  const bool half = depth == ImageDepth::Half;
  const double most = half ? most_half : double{std::numeric_limits<float>::max()};
  const double least = half ? least_half : double{std::numeric_limits<float>::min()};
  const std::string precision = half ? "half" : "single";
  if (largest > most)
    throw std::range_error(precision + " precision has no number as large as " + shortest(largest));
  if (largest > 0 && largest < least) {
    throw std::range_error("displacements of at most " + shortest(largest) + " are too small for " +
                           precision + " precision");
  }
}

ImageTexts layout_texts(const std::optional<TextureLayout>& layout) {
  if (!layout)
    return {{"sphparam:convention", "sphparam"}, {"sphparam:u0", "0"}, {"sphparam:turns", "1"}};
  return {{"sphparam:layout", "grid"},
          {"sphparam:tiles", std::to_string(layout->columns) + "x" + std::to_string(layout->rows)},
          {"sphparam:gutter", std::to_string(layout->gutter)},
          {"sphparam:levels", std::to_string(layout->levels)},
          {"sphparam:recipe", recipe}};
}

}  // namespace

DisplacementCoding coding_of(const Displacement& displacement, ImageDepth depth) {
  const double width = displacement.figures.greatest - displacement.figures.least;
  if (depth != ImageDepth::Uint16 || !(width > 0))
    return {1, depth == ImageDepth::Uint16 ? -displacement.figures.least : 0};
  return {width, -displacement.figures.least / width};
}

std::vector<char> encode_displacement(const Displacement& displacement, ImageDepth depth,
                                      const std::string& grid, const std::string& scheme,
                                      const std::optional<TextureLayout>& layout) {
  const double largest = std::max(-displacement.figures.least, displacement.figures.greatest);
  require_representable(largest, depth);
  const DisplacementCoding coding = coding_of(displacement, depth);
  Image coded = displacement.image;
  if (depth == ImageDepth::Uint16) {
    for (float& value : coded.pixels) {
      value = static_cast<float>(static_cast<double>(value) / coding.scale + coding.midlevel);
    }
  }
  ImageWriteOptions options{.sample_type = depth == ImageDepth::Uint16 ? SampleType::Uint16
                                           : depth == ImageDepth::Half ? SampleType::Half
                                                                       : SampleType::Float,
                            .metadata = {{"sphparam:map", "displacement"},
                                         {"sphparam:about", about},
                                         {"sphparam:units", "of the mesh"},
                                         {"sphparam:direction", "outwards"},
                                         {"sphparam:scale", shortest(coding.scale)},
                                         {"sphparam:midlevel", shortest(coding.midlevel)}}};
  const ImageTexts of_layout = layout_texts(layout),
                   of_base = {{"sphparam:grid", grid},
                              {"sphparam:scheme", scheme},
                              {"sphparam:depth", name_of(depth)},
                              {"sphparam:min", shortest(displacement.figures.least)},
                              {"sphparam:max", shortest(displacement.figures.greatest)}};
  for (const ImageTexts& texts : {of_layout, of_base})
    options.metadata.insert(options.metadata.end(), texts.begin(), texts.end());
  return encode_image(coded, depth == ImageDepth::Uint16 ? ImageFormat::Png : ImageFormat::Exr,
                      options);
}

Image decode_displacement(std::string_view bytes, const std::string& name) {
  ImageTexts texts;
  constexpr ImageLimits own = {.file_bytes = std::numeric_limits<std::int64_t>::max(),
                               .decoded_megabytes = std::numeric_limits<std::int32_t>::max()};
  Image image = decode_image({bytes.begin(), bytes.end()}, name, own, &texts);
  if (image.channels != 1) throw ImageError(name + ": no displacement: it has several channels");
  const double scale = number_of(texts, "sphparam:scale", name),
               midlevel = number_of(texts, "sphparam:midlevel", name);
  for (float& value : image.pixels) {
    value = static_cast<float>((static_cast<double>(value) - midlevel) * scale);
    if (!std::isfinite(value)) throw ImageError(name + ": a distance is not finite");
  }
  return image;
}

}  // namespace sphparam
