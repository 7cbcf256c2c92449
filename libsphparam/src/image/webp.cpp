// The encoder is libwebp, in the module; here is what it is given, and whether it is what comes
// back.

#include "image/webp.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "image/image_codec.h"
#include "image/integer_sample.h"
#include "image/open_module.h"
#include "image/sinks.h"

namespace sphparam {
namespace {

using Samples = std::vector<std::uint8_t>;

/// RGB, or RGBA where there is alpha.
Samples colours_of(const Image& image) {
  const int channels = image.channels;
  const bool grey = channels <= 2, alpha = channels % 2 == 0;
  Samples samples;
  const std::size_t texels = image.pixels.size() / static_cast<std::size_t>(channels);
  samples.reserve(texels * (alpha ? 4 : 3));
  for (std::size_t i = 0; i < texels; ++i) {
    const float* const texel = &image.pixels[i * static_cast<std::size_t>(channels)];
    for (int k = 0; k < 3; ++k)
      samples.push_back(integer_sample<std::uint8_t>(texel[grey ? 0 : k]));
    if (alpha) samples.push_back(integer_sample<std::uint8_t>(texel[channels - 1]));
  }
  return samples;
}

/// Alpha that is 1 everywhere is not in the file.
void require_kept(const std::vector<char>& bytes, const Samples& meant, const SphparamWebp& image) {
  const Image found = decode_image(bytes, "a WebP image, read back");
  const auto channels = static_cast<std::size_t>(image.channels),
             there = static_cast<std::size_t>(found.channels);
  if (found.width != image.width || found.height != image.height || there < 3)
    throw ImageError("the WebP image, read back, has another size");
  for (std::size_t i = 0; i < meant.size(); ++i) {
    const std::size_t texel = i / channels, channel = i % channels;
    if (channel < 3 && !image.lossless) continue;
    const std::uint8_t value =
        channel < there ? integer_sample<std::uint8_t>(found.pixels[texel * there + channel])
                        : std::uint8_t{255};
    if (value != meant[i]) throw ImageError("the WebP image, read back, differs");
  }
}

}  // namespace

std::vector<char> encode_webp(const Image& image, const WebpOptions& options) {
  if (std::max(image.width, image.height) > most_webp_side)
    throw ImageError("WebP images have at most " + std::to_string(most_webp_side) +
                     " texels a side, not " + std::to_string(image.width) + " x " +
                     std::to_string(image.height));
  const Samples samples = colours_of(image);
  const SphparamWebp described = {.width = image.width,
                                  .height = image.height,
                                  .channels = image.channels % 2 == 0 ? 4 : 3,
                                  .samples = samples.data(),
                                  .lossless = options.lossless,
                                  .quality = options.quality};
  std::vector<char> bytes;
  std::string error;
  if (image_codecs().encode_webp(&described, into(bytes), into(error)) != 0)
    throw_told("cannot encode the image: ", error);
  require_kept(bytes, samples, described);
  return bytes;
}

}  // namespace sphparam
