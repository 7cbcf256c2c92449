#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/surface_point.h"

namespace sphparam {

/// For each sample, which vertices of a mesh it is a mean of: entry e of sample i, for
/// starts[i] ≤ e < starts[i + 1], has the vertex and its weight; weights of a sample sum to 1 up to
/// rounding.
struct Gather {
  std::vector<std::int64_t> starts;
  std::vector<Vertex> vertices;
  std::vector<double> weights;

  std::int64_t count() const { return static_cast<std::int64_t>(starts.size()) - 1; }
};

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

/// One channel of sRGB, of any type. At points as stored, which is what viewers do between
/// vertices; over cells in linear light, but for the channel "alpha".
std::vector<double> resample_colour(const Resampling& resampling, const Property& channel);

/// For values that name something: that of the largest total weight, the lowest where there are
/// several.
std::vector<double> resample_labels(const Resampling& resampling, const Property& property);

}  // namespace sphparam
