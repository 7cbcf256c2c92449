#pragma once

#include <string>
#include <string_view>

#include "image/image_codec.h"

namespace sphparam {

/// Whether the first 18 bytes are the head of a Truevision TGA file. There is no magic number:
/// every field has to make sense.
bool looks_like_targa(std::string_view bytes);

/// Grey of 8 bits, with alpha of 16, colours of 15, 16 (their one bit of alpha is not read), 24 and
/// 32, palettes of these, as they are or in runs. Four channels where some alpha is not zero. Our
/// own, as `decode_bmp` is. Source: Truevision, "TGA File Format Specification 2.0". Throws:
/// ReadError; also beyond the limits.
Image decode_targa(std::string_view bytes, const std::string& name, const ImageLimits& limits);

}  // namespace sphparam
