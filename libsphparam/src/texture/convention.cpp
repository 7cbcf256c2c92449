#include "sphparam/texture/convention.h"

#include <algorithm>
#include <cmath>

#include "option_domain.h"

namespace sphparam {

const std::vector<ConventionInfo>& all_conventions() {
  static const std::vector<ConventionInfo> conventions = {
      {Convention::Sphparam, "sphparam", 1, 0.0}, {Convention::Three, "three", 1, 0.5},
      {Convention::Gis, "gis", 1, 0.5},           {Convention::Envmap, "envmap", -1, 0.25},
      {Convention::Blender, "blender", -1, 0.5},
  };
  return conventions;
}

const ConventionInfo& info_of(Convention convention) {
  require_one_of("convention", convention, Convention::Blender);
  return all_conventions()[static_cast<size_t>(convention)];
}

std::optional<Convention> convention_named(std::string_view name) {
  for (const ConventionInfo& info : all_conventions()) {
    if (name == info.name) return info.convention;
  }
  return std::nullopt;
}

/// The texel of column c at u has our longitude u₀: u = turns·u₀ + offset. Centres go to centres:
/// mirrored, column x is that of u = 1 − (x + ½)/W.
std::vector<float> in_convention(Convention convention, int width, int channels, int rows,
                                 const float* values) {
  const ConventionInfo& info = info_of(convention);
  const auto shift = static_cast<int>(std::lround(info.offset * width));
  const auto texel = static_cast<size_t>(channels), line = static_cast<size_t>(width) * texel;
  std::vector<float> moved(static_cast<size_t>(rows) * line);
  float* out = moved.data();
  for (int row = 0; row < rows; ++row, values += line) {
    for (int c = 0; c < width; ++c) {
      const int ours = info.turns > 0 ? c - shift : shift - 1 - c;
      const int column = ((ours % width) + width) % width;
      out = std::copy_n(values + static_cast<size_t>(column) * texel, texel, out);
    }
  }
  return moved;
}

}  // namespace sphparam
