#pragma once

#include <string>

#include "render/render.h"
#include "sphparam/image/image.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam {

/// How numbers become colours, and what stands beside the scale: from blue by white at 0 to red
/// where `low` is −high, else viridis from dark to yellow. Values beyond have the last colour.
struct HeatScale {
  std::string title;
  double low, high;
  bool log_ratios = false;  // values are log₂ of the ratios that the scale shows
  // Whether values lie beyond an end, which its number says then: "≤ 0.1", "≥ 0.9". Not of ratios.
  bool below = false, above = false;
  bool given = false;  // its ends are numbers that somebody typed, which are shown as they are

  bool diverges() const { return low == -high; }
};

Rgb heat_colour(const HeatScale& scale, double value);

/// Distortion as colours of triangles. The scales are fixed, so that pictures of different maps
/// compare: area ratios from 1/8 (blue) by 1 (white) to 8 (red), logarithmic; angles from 1 (dark)
/// to a factor of 8 (yellow), the mean |ln ratio| of a triangle's three angles; stretch as areas.
enum class Heat { Area, Angle, Stretch };

const HeatScale& heat_scale(Heat heat);

/// One value a triangle, log₂ of a ratio: of areas; of the factor by which angles are off, in the
/// geometric mean; of how far the image is stretched over the surface, √((σ₁⁻² + σ₂⁻²)/2), the L²
/// stretch of Sander et al. 2001.
VectorX heat_values(Heat heat, const Distortion& distortion);

FacePaint heat_paint(Heat heat, const Distortion& distortion);

/// The colour of a ratio; for angles, of the factor by which they are off.
Rgb heat_colour(Heat heat, double ratio);

/// The picture with the scale and its numbers on a white strip below it; pictures of fewer than 160
/// pixels either way are too small to read it on and stay as they are.
Image with_legend(const Image& picture, const HeatScale& scale);
Image with_legend(const Image& picture, Heat heat);

}  // namespace sphparam
