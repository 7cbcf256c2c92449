#pragma once

#include <array>
#include <span>

#include "bake/surface_field.h"

namespace sphparam {

/// The values of a field that is linear on every face: corner(face, k, value) writes those of a
/// corner. Three multiplications a run, one a texel.
template <int channels, class Corner>
void fill_linear(std::span<const SurfaceRun> runs, float* values, const Corner& corner) {
  for (const SurfaceRun& run : runs) {
    std::array<double, channels> first{}, step{};
    for (int k = 0; k < 3; ++k) {
      std::array<double, channels> value;
      corner(run.face, k, value);
      for (size_t c = 0; c < channels; ++c) {
        first[c] += run.first[k] * value[c];
        step[c] += run.step[k] * value[c];
      }
    }
    for (int i = 0; i < run.count; ++i) {
      for (size_t c = 0; c < channels; ++c) *values++ = static_cast<float>(first[c] + i * step[c]);
    }
  }
}

/// A field of numbers that is linear on every face. Requires: what `corner` refers to outlives it.
template <int channels, class Corner>
SurfaceField linear_field(SurfaceField described, Corner corner) {
  described.channels = channels;
  described.evaluate_runs = [corner](std::span<const SurfaceRun> runs, float* values) {
    fill_linear<channels>(runs, values, corner);
  };
  return described;
}

}  // namespace sphparam
