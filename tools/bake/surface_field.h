#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/mesh/surface_point.h"

namespace sphparam::tools {

/// What the values of a field are, and so how they may be filtered and stored.
enum class FieldKind : std::uint8_t {
  Colour,     // sRGB in [0, 1] as stored; averaged in linear light
  Data,       // averaged as it is, never colour-converted
  Direction,  // unit vectors: averaged, then made unit again; stored as ½ + ½·n in integers
  Label,      // never averaged: the value at the texel's centre
};

/// A point of the source surface that a texel asks for.
struct SurfaceSample {
  SurfacePoint point;  // in the source mesh
  std::uint64_t seed;  // of the texel and sample: the same for any number of threads and tiles
};

/// Something that has a value everywhere on the source mesh: a texture, a property, what rays see.
struct SurfaceField {
  std::string name;  // "position", "scalar:thickness"
  int channels = 1;  // 1, 3 or 4
  FieldKind kind = FieldKind::Data;
  std::string about;  // one line for metadata: unit, space, convention
  // Where values of integer images come from and go to; none: known only once all are baked.
  std::optional<std::pair<double, double>> range = std::nullopt;
  /// Fills values[channels·i …] for sample i. Called from many threads at once.
  std::function<void(std::span<const SurfaceSample> samples, float* values)> evaluate;
};

}  // namespace sphparam::tools
