#pragma once

#include <string>
#include <utility>
#include <vector>

#include "remesh/grids/grid_family.h"
#include "sphparam/image/image.h"
#include "sphparam/remesh/geometry_image.h"
#include "sphparam/remesh/image_depth.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

/// Requires: has_image_layout(spec); `directions` of that grid.
ImageLayout image_layout(const GridSpec& spec, const Points& directions);

/// Values a vertex as an image that can be turned back, and the texts that must go with it:
/// sphparam:grid, sphparam:depth and, of 16-bit integers, sphparam:min and sphparam:max a channel;
/// of floats sphparam:offset a channel, where values that are far from 0 for their extent are less
/// that.
struct GeometryImage {
  Image image;
  std::vector<std::pair<std::string, std::string>> texts;
};

/// `values`: `channels` numbers a vertex. 16 bits hold the range from the least to the greatest of
/// each channel in 65,535 steps.
/// Ensures: what is decoded is the nearest that the depth can hold.
/// Throws: std::range_error where half (65,504) or float has no such number.
GeometryImage make_geometry_image(const GridSpec& spec, const Points& directions,
                                  const std::vector<double>& values, int channels,
                                  ImageDepth depth);

/// The values of each vertex of the grid that an image names, `channels` of them.
struct ImageContents {
  GridSpec spec;
  int channels = 0;
  SphereGrid grid;
  std::vector<double> values;
};

/// Throws: std::invalid_argument, saying what is missing or wrong: no grid named, another size,
/// samples of one vertex that differ, values that are not finite.
ImageContents read_geometry_image(const Image& image,
                                  const std::vector<std::pair<std::string, std::string>>& texts,
                                  int threads = 0);

}  // namespace sphparam
