#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sphparam {

/// What the images of an asset are in its files.
enum class TextureFormat {
  Given,         // PNG and JPEG as they are; others as PNG
  Png,           // all of them
  Jpeg,          // colours without alpha, where that is smaller; others as given
  Webp,          // all that become smaller; EXT_texture_webp, which browsers and engines read
  WebpLossless,  // likewise, and no bit of colours is lost either
};

/// "given", "png", "jpeg", "webp", "webp-lossless".
const char* word_of(TextureFormat format);

/// What became of an image.
struct TextureFigures {
  std::string name = {};
  const char* kind = "";  // "png", "jpeg", "webp"
  std::size_t given_bytes = 0, bytes = 0;
  bool exact = true;  // every sample of 8 bits is as it was given
};

/// "3 images of 1.2 MB in all, 9.1 MB as given: 1 webp with loss, 1 webp, 1 png": for people.
/// Requires: at least one.
std::string words_of(const std::vector<TextureFigures>& textures);

}  // namespace sphparam
