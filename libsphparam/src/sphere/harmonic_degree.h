#pragma once

#include <stdexcept>
#include <string>

#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// Throws: std::invalid_argument for a degree that the recursion does not reach.
inline void require_harmonic_degree(int degree) {
  if (degree >= 0 && degree <= greatest_harmonic_degree) return;
  throw std::invalid_argument("spherical harmonics: degree " + std::to_string(degree) +
                              " is not within 0 … " + std::to_string(greatest_harmonic_degree));
}

}  // namespace sphparam
