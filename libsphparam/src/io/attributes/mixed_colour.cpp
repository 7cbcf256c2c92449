#include "io/attributes/mixed_colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/attributes/appearance.h"
#include "io/attributes/whole_vector.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

double in_type(ScalarType type, double value) {
  if (type == ScalarType::Float64) return value;
  if (type == ScalarType::Float32) return static_cast<double>(static_cast<float>(value));
  return std::round(value);
}

}  // namespace

bool is_colour_name(std::string_view name) {
  static constexpr std::array<std::string_view, 4> names = {"red", "green", "blue", "alpha"};
  return std::ranges::find(names, name) != names.end();
}

bool is_of_colour(const Property& property, const std::vector<Property>& properties) {
  return is_colour_name(property.name) &&
         (!is_floating(property.type) || is_of_whole_vector(property.name, properties));
}

double mixed_colour(std::string_view channel, ScalarType type,
                    std::span<const std::pair<double, double>> weighed) {
  const SrgbCurves& curves = SrgbCurves::get();
  const double unit = brightest(type);
  double stored = 0, light = 0, least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const auto& [value, weight] : weighed) {
    if (weight == 0) continue;
    stored += weight * value;
    light += weight * static_cast<double>(curves.to_linear(static_cast<float>(value / unit)));
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  const bool is_light = channel != "alpha" && least >= 0 && greatest <= unit;
  const double mean =
      is_light ? static_cast<double>(curves.to_srgb(static_cast<float>(light))) * unit : stored;
  return in_type(type, least < greatest ? std::clamp(mean, least, greatest) : least);
}

}  // namespace sphparam
