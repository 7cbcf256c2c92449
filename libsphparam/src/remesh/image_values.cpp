// Numbers are rounded to what the depth can hold before they are laid out, so that what is read
// back is what was made.

#include "remesh/image_values.h"

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

constexpr double most_half = 65504;
constexpr double steps_of_16_bits = 65535;
constexpr char offset_text[] = "sphparam:offset";

using Texts = std::vector<std::pair<std::string, std::string>>;

/// The nearest number of 11 bits, as half precision has them; of fewer below 2⁻¹⁴.
double to_half(double value) {
  if (std::abs(value) > most_half) {
    throw std::range_error("half precision has no number as large as " + std::to_string(value));
  }
  const int exponent = value == 0 ? 0 : std::max(std::ilogb(value), -14);
  return std::ldexp(std::nearbyint(std::ldexp(value, 10 - exponent)), exponent - 10);
}

double to_float(double value) {
  if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
    throw std::range_error("float has no number as large as " + std::to_string(value));
  }
  return static_cast<double>(static_cast<float>(value));
}

struct Range {
  std::vector<double> least, greatest;

  double width(size_t channel) const { return greatest[channel] - least[channel]; }

  /// Whether numbers are so large for their extent that some of their digits are no float's.
  bool is_far() const {
    constexpr double far_by = 128;  // 128 · 2^-24 is 1e-5 of the extent
    double size = 0, extent = 0;
    for (size_t k = 0; k < least.size(); ++k) {
      size = std::max({size, std::abs(least[k]), std::abs(greatest[k])});
      extent = std::max(extent, width(k));
    }
    return extent > 0 && size > far_by * extent;
  }
};

Range range_of(const std::vector<double>& values, size_t channels) {
  Range range{{values.begin(), values.begin() + static_cast<std::ptrdiff_t>(channels)}, {}};
  range.greatest = range.least;
  for (size_t i = 0; i < values.size(); ++i) {
    range.least[i % channels] = std::min(range.least[i % channels], values[i]);
    range.greatest[i % channels] = std::max(range.greatest[i % channels], values[i]);
  }
  return range;
}

/// What floats are counted from, a channel; empty where that is 0, as where they hold all numbers.
std::vector<double> offset_of(const std::vector<double>& values, const Range& range,
                              ImageDepth depth) {
  const auto is_lost = [depth](double value) {
    if (depth == ImageDepth::Half) return std::abs(value) > most_half || to_half(value) != value;
    return static_cast<double>(static_cast<float>(value)) != value;
  };
  const bool needed = depth != ImageDepth::Uint16 && range.is_far() &&
                      std::any_of(values.begin(), values.end(), is_lost);
  return needed ? range.least : std::vector<double>();
}

double quantised(double value, ImageDepth depth, const Range& range, size_t channel) {
  if (depth == ImageDepth::Half) return to_half(value);
  if (depth == ImageDepth::Float) return to_float(value);
  const double width = range.width(channel);
  return width > 0 ? std::nearbyint((value - range.least[channel]) / width * steps_of_16_bits) /
                         steps_of_16_bits
                   : 0;
}

std::string text_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text.append(text.empty() ? "" : " ").append(shortest(number));
  return text;
}

std::optional<std::string> text_named(const Texts& texts, const std::string& name) {
  for (const auto& [key, value] : texts) {
    if (key == name) return value;
  }
  return std::nullopt;
}

std::vector<double> numbers_of(const Texts& texts, const std::string& name, size_t count) {
  const std::string text = text_named(texts, name).value_or("");
  std::vector<double> numbers;
  const char *at = text.data(), *const end = at + text.size();
  while (at != end) {
    double number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || !std::isfinite(number)) break;
    numbers.push_back(number);
    at = stop != end && *stop == ' ' ? stop + 1 : stop;
  }
  if (numbers.size() != count) {
    throw std::invalid_argument("its metadata " + name + " is not " + std::to_string(count) +
                                " numbers");
  }
  return numbers;
}

/// One value a vertex and channel, the same wherever the vertex occurs.
std::vector<double> gather(const Image& image, const ImageLayout& layout, std::int64_t vertices) {
  const auto channels = static_cast<size_t>(image.channels);
  std::vector<double> values(static_cast<size_t>(vertices) * channels,
                             std::numeric_limits<double>::quiet_NaN());
  for (size_t i = 0; i < layout.vertex.size(); ++i) {
    for (size_t k = 0; k < channels; ++k) {
      const auto sample = static_cast<double>(image.pixels[i * channels + k]);
      const auto where = [&] {
        const auto width = static_cast<size_t>(layout.width);
        return " at column " + std::to_string(i % width) + ", row " + std::to_string(i / width);
      };
      if (!std::isfinite(sample)) throw std::invalid_argument("a sample is not finite" + where());
      double& value = values[static_cast<size_t>(layout.vertex[i]) * channels + k];
      if (!std::isnan(value) && value != sample) {
        throw std::invalid_argument("samples of one vertex differ" + where());
      }
      value = sample;
    }
  }
  return values;
}

}  // namespace

bool has_image_layout(const GridSpec& spec) { return family_of(spec.kind).image != nullptr; }

ImageLayout image_layout(const GridSpec& spec, const Points& directions) {
  return family_of(spec.kind).image(spec, directions);
}

GeometryImage make_geometry_image(const GridSpec& spec, const Points& directions,
                                  const std::vector<double>& values, int channels,
                                  ImageDepth depth) {
  const ImageLayout layout = image_layout(spec, directions);
  const auto width = static_cast<size_t>(channels);
  const Range range = range_of(values, width);
  const std::vector<double> offset = offset_of(values, range, depth);
  GeometryImage result{Image(layout.width, layout.height, channels),
                       {{"sphparam:grid", name_of(spec)}, {"sphparam:depth", name_of(depth)}}};
  for (size_t i = 0; i < layout.vertex.size(); ++i) {
    for (size_t k = 0; k < width; ++k) {
      const double value = values[static_cast<size_t>(layout.vertex[i]) * width + k] -
                           (offset.empty() ? 0 : offset[k]);
      result.image.pixels[i * width + k] = static_cast<float>(quantised(value, depth, range, k));
    }
  }
  if (depth == ImageDepth::Uint16) {
    result.texts.emplace_back("sphparam:min", text_of(range.least));
    result.texts.emplace_back("sphparam:max", text_of(range.greatest));
  }
  if (!offset.empty()) result.texts.emplace_back(offset_text, text_of(offset));
  return result;
}

ImageContents read_geometry_image(const Image& image, const Texts& texts, int threads) {
  ImageContents contents;
  const std::optional<std::string> name = text_named(texts, "sphparam:grid");
  if (!name) throw std::invalid_argument("its metadata names no grid (sphparam:grid)");
  contents.spec = parse_grid(*name);
  const auto fits = [&](const ImageSize& size) {
    return image.width == size.width && image.height == size.height;
  };
  if (!has_image_layout(contents.spec) ||
      !fits(family_of(contents.spec.kind).image_size(contents.spec))) {
    throw std::invalid_argument("it has " + std::to_string(image.width) + " x " +
                                std::to_string(image.height) + " samples, which is not " + *name);
  }
  contents.channels = image.channels;
  contents.grid = make_grid(contents.spec, {.threads = threads});
  const ImageLayout layout = image_layout(contents.spec, contents.grid.directions);
  contents.values = gather(image, layout, contents.grid.directions.rows());
  if (text_named(texts, "sphparam:depth") == "u16") {
    const auto channels = static_cast<size_t>(image.channels);
    const auto least = numbers_of(texts, "sphparam:min", channels),
               greatest = numbers_of(texts, "sphparam:max", channels);
    for (size_t i = 0; i < contents.values.size(); ++i) {
      const size_t k = i % channels;
      const double step = std::nearbyint(contents.values[i] * steps_of_16_bits);
      contents.values[i] = least[k] + (greatest[k] - least[k]) * (step / steps_of_16_bits);
    }
  } else if (text_named(texts, offset_text)) {
    const auto channels = static_cast<size_t>(image.channels);
    const auto offset = numbers_of(texts, offset_text, channels);
    for (size_t i = 0; i < contents.values.size(); ++i) contents.values[i] += offset[i % channels];
  }
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(contents.values.begin(), contents.values.end(), is_finite)) {
    throw std::invalid_argument("it holds numbers that are not finite, or a range that is none");
  }
  return contents;
}

}  // namespace sphparam
