#pragma once

#include <array>

#include "sphparam/io/materials.h"

namespace sphparam {

/// What a surface is like in the model of glTF 2.0. Colours are linear.
struct MetallicRoughness {
  std::array<double, 3> base_colour;
  double metallic, roughness;
};

/// The surface of that model that reflects most nearly what one of diffuse and specular colour does
/// straight on. Source: the conversion that Khronos gives with KHR_materials_pbrSpecularGlossiness.
MetallicRoughness as_metallic_roughness(const std::array<double, 3>& diffuse,
                                        const std::array<double, 3>& specular, double glossiness);

/// Gives a texture that is made of two images the factor that their factors alone have, and no
/// image.
void leave_factors(MaterialTexture& texture);

}  // namespace sphparam
