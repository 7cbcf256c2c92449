#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/image/image.h"

namespace sphparam {

/// Lets colours run over the borders of what was painted, so that filters and mip levels find no
/// background there: ring by ring, `rings` texels far, each the mean of its painted neighbours
/// among the eight. What is left takes the mean of all that was painted.
/// `painted`: one a texel, 1 or 0; in the end k + 1 in ring k. Requires: rings ≤ 254; values that
/// may be averaged. Cost: one pass, and what is filled.
void pad(Image& image, std::vector<std::uint8_t>& painted, int rings);

}  // namespace sphparam
