#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/image/image.h"
#include "remesh/sphere_grid.h"

namespace sphparam {

/// Which vertex of a grid is at each sample of a square image: the grid cut open and laid flat.
///
/// octa:N: N×N samples. The northern half is the square turned by 45° in the middle, x to the
/// right and y upwards; the southern half is folded out to the corners, which are −z. cube:N: six
/// sides of (N + 1)×(N + 1) samples below one another, +x −x +y −y +z −z, each seen from outside.
/// Samples on the cut occur twice or more, and name the same vertex.
struct ImageLayout {
  int width = 0, height = 0;
  std::vector<int> vertex;  // of sample row·width + column
};

bool has_image_layout(const GridSpec& spec);
/// Requires: has_image_layout(spec); `directions` of that grid.
ImageLayout image_layout(const GridSpec& spec, const Points& directions);

enum class ImageDepth { Half, Float, Uint16 };

/// Values a vertex as an image that can be turned back, and the texts that must go with it:
/// sphparam:grid, sphparam:depth and, of 16-bit integers, sphparam:min and sphparam:max a channel.
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
