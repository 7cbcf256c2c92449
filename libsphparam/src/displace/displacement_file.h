#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "displace/displacement.h"
#include "image/image_codec.h"
#include "sphparam/remesh/image_depth.h"

namespace sphparam {

/// A displacement as an image file: .exr in half or float with the distances themselves, .png in 16
/// bits from `sphparam:min` (0) to `sphparam:max` (65535). Its texts tell what it holds, of which
/// base (`grid` and `scheme` as on the command line), and how: sphparam:map, :about, :units,
/// :direction, :scale, :midlevel, :grid, :scheme, :depth, :min, :max; of an equirectangular image
/// :convention, :u0, :turns; in the layout of the grid :layout, :tiles, :gutter, :levels, :recipe.
/// Throws: ImageError; std::range_error where the distances are too large or too
/// small for the floats of the image, or for half.
std::vector<char> encode_displacement(const Displacement& displacement, ImageDepth depth,
                                      const std::string& grid, const std::string& scheme,
                                      const std::optional<TextureLayout>& layout = {});

/// Height = (value − midlevel)·scale, where value is the number in the file, of 16-bit integers
/// divided by 65535: the two numbers that programs which displace ask for.
struct DisplacementCoding {
  double scale = 1, midlevel = 0;
};
DisplacementCoding coding_of(const Displacement& displacement, ImageDepth depth);

/// The distances of such a file. Throws: ImageError for what is none.
Image decode_displacement(std::string_view bytes, const std::string& name);

}  // namespace sphparam
