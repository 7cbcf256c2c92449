#pragma once

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// Is a chart `one_to_one` with these (u, v) instead of its own? The answer of its certificate,
/// which asks nothing else then, in half the time: not where the points lie, nor how far (u, v) are
/// from theirs. Requires: a chart that is not wrapped.
bool is_one_to_one(const SphericalChart& chart, const TextureCoordinates& uv, int threads = 0);

}  // namespace sphparam
