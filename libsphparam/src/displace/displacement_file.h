#pragma once

#include <string>
#include <string_view>

#include "displace/displacement.h"
#include "image/image_codec.h"
#include "sphparam/remesh/image_depth.h"

namespace sphparam {

/// A displacement as an image file: .exr in half or float with the distances themselves, .png in 16
/// bits from `sphparam:min` (0) to `sphparam:max` (65535). Its texts tell what it holds, of which
/// base (`grid` and `scheme` as on the command line), and how: sphparam:map, :about, :units,
/// :direction, :scale, :midlevel, :convention, :u0, :turns, :grid, :scheme, :depth, :min, :max.
/// Height = (value − midlevel)·scale, where value is the number in the file, of 16-bit integers
/// divided by 65535: the two numbers that programs which displace ask for.
/// Throws: ImageError; std::range_error where the distances are too large or too
/// small for the floats of the image, or for half.
std::vector<char> encode_displacement(const Displacement& displacement, ImageDepth depth,
                                      const std::string& grid, const std::string& scheme);

/// The distances of such a file. Throws: ImageError for what is none.
Image decode_displacement(std::string_view bytes, const std::string& name);

}  // namespace sphparam
