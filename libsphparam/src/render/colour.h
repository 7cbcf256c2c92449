#pragma once

#include <Eigen/Core>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// sRGB as stored in files, each channel in [0, 1].
using Rgb = Eigen::Vector3f;

/// Light can be added and averaged in linear values only (IEC 61966-2-1).
Rgb to_linear(const Rgb& srgb);
Rgb to_srgb(const Rgb& linear);

/// Viridis, dark blue at 0 to yellow at 1.
Rgb viridis(double t);

/// Blue at −1, near white at 0, red at 1.
Rgb diverging(double t);

/// Colours of positive ratios on a diverging logarithmic scale: white at 1, full red at `reach`
/// and beyond, full blue at 1/reach.
std::vector<Rgb> ratio_colours(const VectorX& ratios, double reach);

/// Colours of values on viridis from `low` to `high`.
std::vector<Rgb> value_colours(const VectorX& values, double low, double high);

}  // namespace sphparam
