#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sphparam/texture/texture_options.h"

namespace sphparam {

/// Which texels of an image a mesh looks at. What lies between the charts of an atlas is no colour
/// of the surface, and is not to be mixed with those that are.
class SeenTexels {
 public:
  /// All of them: nothing is known of who looks.
  SeenTexels() = default;
  /// None yet. Requires: at least one texel.
  SeenTexels(int width, int height);

  /// Where a corner of a triangle looks, in texels, y downwards from the top.
  using Corners = std::array<std::array<double, 2>, 3>;
  /// Adds what a triangle looks at. May be called by many threads at once. Cost: that of the
  /// texels.
  void add(const Corners& corners, TextureWrap wrap_s, TextureWrap wrap_t);

  bool all() const { return inside_.empty(); }
  /// In means: 1 where the texel's middle is in a triangle, next to nothing where only a bilinear
  /// look-up of one touches it, 0 elsewhere.
  float weight(std::size_t texel) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<char> inside_, touched_;  // a texel; empty: all
};

}  // namespace sphparam
