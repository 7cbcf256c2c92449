#pragma once

#include <algorithm>
#include <cmath>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// How long rays are.
struct Radius {
  double mean = 0, greatest = 0;
  double deviation = 0;  // largest | |x| / mean − 1 |
};

/// Of rays of any finite length: squares are taken of the rays divided by a power of two, which
/// changes no bit where they were numbers anyway. Requires: at least one ray.
inline Radius measure_radius(const Points& rays) {
  const double largest = rays.cwiseAbs().maxCoeff();
  const bool finite = rays.allFinite() && largest > 0;
  const int exponent = finite ? std::clamp(std::ilogb(largest), -1000, 1000) : 0;
  const VectorX lengths = (rays * std::ldexp(1.0, -exponent)).rowwise().norm();
  const double mean = lengths.mean();
  return {std::ldexp(mean, exponent), std::ldexp(lengths.maxCoeff(), exponent),
          (lengths.array() / mean - 1).abs().maxCoeff()};
}

constexpr double largest_ray = 0x1p64;  // that signs are exact for

/// Longer rays, divided by a power of two each: they stay the same rays.
inline void shorten(Points& rays) {
  for (Eigen::Index v = 0; v < rays.rows(); ++v) {
    const double largest = rays.row(v).cwiseAbs().maxCoeff();
    if (rays.row(v).allFinite() && largest > largest_ray)
      rays.row(v) *= std::ldexp(1.0, -std::ilogb(largest));
  }
}

}  // namespace sphparam
