#include "texture/specular_glossiness_image.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "io/attributes/specular_glossiness.h"
#include "sphparam/parallel.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

/// Linear red, green, blue, and alpha.
using Texel = std::array<double, 4>;

/// Of an image with w × h texels there, times its factor.
Texel texel(const Image& image, int x, int y, const Image& there, const Texel& factor) {
  if (image.pixels.empty()) return factor;
  const auto scaled = [](std::int64_t at, int size, int of) {
    return static_cast<int>(at * size / of);
  };
  const float* const pixel =
      image.pixel(scaled(x, image.width, there.width), scaled(y, image.height, there.height));
  const bool grey = image.channels < 3, alpha = image.channels % 2 == 0;
  Texel result = factor;
  for (std::size_t c = 0; c < 3; ++c)
    result[c] *= static_cast<double>(SrgbCurves::get().to_linear(pixel[grey ? 0 : c]));
  if (alpha) result[3] *= static_cast<double>(pixel[image.channels - 1]);
  return result;
}

std::array<double, 3> rgb(const Texel& texel) { return {texel[0], texel[1], texel[2]}; }

}  // namespace

Image metallic_roughness_image(const SpecularGlossiness& said, const Image& diffuse,
                               const Image& specular, bool numbers, int threads) {
  constexpr std::int64_t rows_at_once = 16;
  Image image(std::max(diffuse.width, specular.width), std::max(diffuse.height, specular.height),
              numbers ? 3 : 4);
  parallel_for(image.height, rows_at_once, threads, [&](std::int64_t first, std::int64_t last) {
    for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Texel d = texel(diffuse, x, y, image, said.diffuse.factor),
                    s = texel(specular, x, y, image, said.specular.factor);
        const auto [colour, metallic, roughness] = as_metallic_roughness(rgb(d), rgb(s), s[3]);
        float* const made = image.pixel(x, y);
        if (numbers) {
          made[0] = 1;
          made[1] = static_cast<float>(roughness);
          made[2] = static_cast<float>(metallic);
          continue;
        }
        for (std::size_t c = 0; c < 3; ++c)
          made[c] = SrgbCurves::get().to_srgb(static_cast<float>(colour[c]));
        made[3] = static_cast<float>(d[3]);
      }
    }
  });
  return image;
}

}  // namespace sphparam
