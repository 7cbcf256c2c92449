#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Directions about an axis, as dense as the cosine of their angle to it: what a matt surface
/// gathers light by.
///
/// They come in pairs opposite each other about the axis, so that the mean of all is along it to
/// the rounding; the pairs lie on a spiral with the golden angle, turned and shifted by the seed.
class CosineRays {
 public:
  /// An odd number becomes the next even one. Requires: count ≥ 1.
  explicit CosineRays(int count);

  int count() const { return 2 * static_cast<int>(spiral_.size()); }

  /// Unit vectors; the same for the same seed. Requires: unit axis; directions.size() == count().
  void aim(const Eigen::Vector3f& axis, std::uint64_t seed,
           std::span<Eigen::Vector3f> directions) const;

 private:
  std::vector<Eigen::Vector2f> spiral_;  // unit vectors
};

}  // namespace sphparam
