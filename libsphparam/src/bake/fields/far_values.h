#pragma once

#include "mesh/box.h"

namespace sphparam {

/// Values of this size, rounded to float32, lose more than some 1e-5 of their extent where they are
/// larger by more than this: 128 · 2^-24 is 0.8e-5.
constexpr double far_by = 128;

inline bool is_far(double size, const Box& box) { return size > far_by * box.longest_side(); }

}  // namespace sphparam
