// A share m of metal reflects F = m · colour + (1 − m) · 0.04 straight on and diffuses
// D = (1 − m) · 0.96 · colour / (1 − max F): with the brightness of both given, m is the root of a
// quadratic equation. The colour is that of D where there is little metal, of F where there is
// much.

#include "io/attributes/specular_glossiness.h"

#include <algorithm>
#include <cmath>

namespace sphparam {
namespace {

using Colour = std::array<double, 3>;

constexpr double dielectric = 0.04;  // what anything but metal reflects
constexpr double least = 1e-6;       // of what is divided by

/// As bright as eyes see it.
double brightness(const Colour& c) {
  return std::sqrt(0.299 * c[0] * c[0] + 0.587 * c[1] * c[1] + 0.114 * c[2] * c[2]);
}

double metallic_of(double diffuse, double specular, double left) {
  if (specular < dielectric) return 0;
  const double b = diffuse * left / (1 - dielectric) + specular - 2 * dielectric;
  const double c = dielectric - specular;
  const double root = std::sqrt(std::max(b * b - 4 * dielectric * c, 0.0));
  return std::clamp((root - b) / (2 * dielectric), 0.0, 1.0);
}

}  // namespace

MetallicRoughness as_metallic_roughness(const Colour& diffuse, const Colour& specular,
                                        double glossiness) {
  const double left = 1 - std::ranges::max(specular);  // for what is diffused
  const double metallic = metallic_of(brightness(diffuse), brightness(specular), left);
  MetallicRoughness result{{}, metallic, std::clamp(1 - glossiness, 0.0, 1.0)};
  for (std::size_t c = 0; c < 3; ++c) {
    const double of_diffuse = diffuse[c] * left / (1 - dielectric) / std::max(1 - metallic, least);
    const double of_specular =
        (specular[c] - dielectric * (1 - metallic)) / std::max(metallic, least);
    const double share = metallic * metallic;
    result.base_colour[c] = std::clamp(of_diffuse + share * (of_specular - of_diffuse), 0.0, 1.0);
  }
  return result;
}

void leave_factors(MaterialTexture& texture) {
  const SpecularGlossiness said = *texture.made_of;
  const auto rgb = [](const std::array<double, 4>& c) { return Colour{c[0], c[1], c[2]}; };
  const auto [colour, metallic, roughness] = as_metallic_roughness(
      rgb(said.diffuse.factor), rgb(said.specular.factor), said.specular.factor[3]);
  texture.made_of = nullptr;
  texture.image.clear();
  if (texture.channel == 0)
    texture.factor = {colour[0], colour[1], colour[2], said.diffuse.factor[3]};
  else
    texture.factor[0] = texture.channel == 1 ? roughness : metallic;
}

}  // namespace sphparam
