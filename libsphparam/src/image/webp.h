#pragma once

#include <vector>

#include "sphparam/image/image.h"

namespace sphparam {

/// The longest side of a WebP image.
constexpr int most_webp_side = 16383;

struct WebpOptions {
  bool lossless = true;  // all of it, what is transparent too
  int quality = 90;      // else: 1 to 100; alpha is kept
};

/// The bytes of a WebP file, of 8 bits a channel, values clamped to [0, 1]; grey becomes RGB. Read
/// back: what is lossless is compared sample by sample, else sizes and alpha.
/// Ensures: the same bytes for the same image. Requires: 1 to 4 channels; 2 are grey and alpha.
/// Throws: ImageError; also beyond `most_webp_side`.
/// Cost: some 0.4 s a megatexel, 2 s where it is lossless.
std::vector<char> encode_webp(const Image& image, const WebpOptions& options = {});

}  // namespace sphparam
