#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace sphparam {

/// Where longitude goes in an equirectangular image; v is ϕ/π, row 0 north, in all of them.
enum class Convention {
  Sphparam,  // u = θ/2π: ours, and that of three.js's PolyhedronGeometry
  Three,     // three.js SphereGeometry: θ = 0 in the middle
  Gis,       // plate carrée, longitude −180° … 180°, 0° in the middle
  Envmap,    // OpenEXR and OpenImageIO latitude-longitude maps, seen from inside
  Blender,   // Cycles environment textures, seen from inside
};

/// u of a convention as a function of ours, u₀ = θ/2π: turns·u₀ + offset, modulo 1.
struct ConventionInfo {
  Convention convention;
  const char* name;
  int turns;      // 1; −1: mirrored, seen from inside
  double offset;  // in turns: 0, ¼ or ½
};

/// All conventions, in the order in which they are listed. Source: the viewers named, their u at
/// the axes measured.
const std::vector<ConventionInfo>& all_conventions();
/// The row of a convention. Throws: std::invalid_argument for what is none.
const ConventionInfo& info_of(Convention convention);
/// By its name on the command line; nothing for a name nobody knows.
std::optional<Convention> convention_named(std::string_view name);

/// Rows of texels in u = θ/2π, interleaved, with their columns where the convention has them.
/// Requires: a width whose product with the offset is whole.
std::vector<float> in_convention(Convention convention, int width, int channels, int rows,
                                 const float* values);

}  // namespace sphparam
