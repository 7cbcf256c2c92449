#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "image/image_codec.h"
#include "io/files/byte_reader.h"

namespace sphparam {

// What our own decoders share: files of 8 bits a sample, read by a `ByteReader`, whose ReadErrors
// `decode_image` hands on.

/// Throws: ReadError where there are no pixels, or more than the limits allow.
inline void require_size(const ByteReader& file, std::int64_t width, std::int64_t height,
                         int channels, const ImageLimits& limits) {
  constexpr std::int64_t longest = std::int64_t{1} << 20;
  if (width <= 0 || height <= 0) file.fail("not an image with at least one pixel");
  const bool wide = width > longest || height > longest;
  if (wide || width * height * channels > (limits.decoded_megabytes << 20))
    file.fail(std::to_string(width) + " x " + std::to_string(height) +
              " pixels are more than the limit of " + std::to_string(limits.decoded_megabytes) +
              " MB");
}

/// Many programs write a channel of alpha and leave it at zero: such an image has none.
inline void drop_empty_alpha(Image& image) {
  if (image.channels % 2 != 0) return;
  const auto all = static_cast<std::size_t>(image.channels), colours = all - 1;
  for (std::size_t i = colours; i < image.pixels.size(); i += all)
    if (image.pixels[i] != 0) return;
  Image opaque(image.width, image.height, image.channels - 1);
  for (std::size_t i = 0; i < opaque.pixels.size(); ++i)
    opaque.pixels[i] = image.pixels[i / colours * all + i % colours];
  image = std::move(opaque);
}

}  // namespace sphparam
