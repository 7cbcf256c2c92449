#pragma once

#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/surface_point.h"
#include "sphparam/remesh/resample.h"

namespace sphparam {

/// Where samples of a surface take their values from: at points of it, or, where `cells` has
/// entries for a sample, from the mean over its cell.
struct Resampling {
  const Triangles& triangles;  // of the source
  const std::vector<SurfacePoint>& points;
  const Gather& cells;
  int threads = 0;
};

/// Means of `width` numbers a vertex, row by row. Every number lies between those it is a mean of,
/// and one that has all the weight is copied.
std::vector<double> resample(const Resampling& resampling, const double* values, int width);

/// The same in float32 or integers of the property's type, for properties that are measured.
std::vector<double> resample_property(const Resampling& resampling, const Property& property);

/// One channel of sRGB, of any type, in linear light: see `mixed_colour`.
std::vector<double> resample_colour(const Resampling& resampling, const Property& channel);

/// For values that name something: that of the largest total weight, the lowest where there are
/// several.
std::vector<double> resample_labels(const Resampling& resampling, const Property& property);

}  // namespace sphparam
