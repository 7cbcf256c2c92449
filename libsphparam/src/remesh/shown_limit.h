#pragma once

#include <algorithm>
#include <cstdint>

#include "sphparam/io/polygons.h"

namespace sphparam {

/// How many pieces a limit surface is cut into to be shown and measured: so many that its flatness
/// is not what is seen, and no more than 16 along a side of a patch, where it is a two-thousandth
/// of how far the patch bends.
inline std::int64_t shown_pieces(const Polygons& patches) {
  constexpr std::int64_t enough = 250'000, of_a_patch = 16 * 16;
  return std::min<std::int64_t>(enough, of_a_patch * patches.count());
}

}  // namespace sphparam
