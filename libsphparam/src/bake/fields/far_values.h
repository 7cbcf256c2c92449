#pragma once

#include "mesh/box.h"

namespace sphparam {

/// Whether values of this size, rounded to float32, lose more than some 1e-5 of a mesh's extent.
inline bool is_far(double size, const Box& box) {
  constexpr double most = 128;  // 128 · 2^-24 is 0.8e-5
  return size > most * box.longest_side();
}

}  // namespace sphparam
