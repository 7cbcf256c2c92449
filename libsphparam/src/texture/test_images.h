#pragma once

#include <optional>
#include <string_view>

#include "sphparam/image/image.h"
#include "sphparam/texture/convention.h"

namespace sphparam {

/// Equirectangular images that show how a sphere lies on a mesh: exact functions of the direction,
/// the mean over each texel in linear light.
enum class TestImage {
  Axes,     // six fields in six colours, lettered +X −X +Y −Y +Z −Z to be read from outside:
            // upright with +z up; ±Z with +y up
  Checker,  // fields of 15° of θ and ϕ, dark and light
  Graticule,  // lines every 15°, the equator blue, the date line θ = 0 red
};

/// "axes", "checker", "graticule".
const char* name_of(TestImage image);
std::optional<TestImage> test_image_named(std::string_view name);

/// `rows` rows from `first_row` on of the image of width × height texels: three sRGB values a texel
/// to rgb[0 … 3·width·rows). Requires: width, height ≥ 1. Cost: some ns a texel, 1 µs at the rims
/// of letters. Same values for any number of threads.
void draw_test_rows(TestImage image, int width, int height, Convention convention, int first_row,
                    int rows, float* rgb, int threads = 0);

/// All of it, half as high as wide.
Image make_test_image(TestImage image, int width, Convention convention = Convention::Sphparam,
                      int threads = 0);

}  // namespace sphparam
