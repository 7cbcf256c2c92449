#pragma once

#include <string>
#include <vector>

#include "image/image.h"
#include "render/render.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam::tools {

/// Distortion as colours of triangles. The scales are fixed, so that pictures of different maps
/// compare: area ratios from 1/8 (blue) by 1 (white) to 8 (red), logarithmic; angles from 1 (dark)
/// to a factor of 8 (yellow), the mean |ln ratio| of a triangle's three angles.
enum class Heat { Area, Angle };

FacePaint heat_paint(Heat heat, const Distortion& distortion);

/// The colour of a ratio; for angles, of the factor by which they are off.
Rgb heat_colour(Heat heat, double ratio);

/// The picture with the scale and its ratios on a white strip below it; pictures of fewer than 160
/// pixels either way are too small to read it on and stay as they are.
Image with_legend(const Image& picture, Heat heat);

}  // namespace sphparam::tools
