#pragma once

#include <string>
#include <string_view>

#include "image/image_codec.h"

namespace sphparam {

/// Whether bytes begin as a BMP file of Windows, or of OS/2 1.x, does.
bool looks_like_bmp(std::string_view bytes);

/// Palettes of 1, 2, 4 and 8 bits, also as run lengths, and colours of 16, 24 and 32 bits, by masks
/// or not; three channels, or four where some alpha is not zero. Our own: the decoders of
/// OpenImageIO in Debian 12 have known holes, and the format is simple. Source: Microsoft, Windows
/// GDI, "Bitmap Storage". Throws: ReadError; also for PNG or JPEG within, and beyond the limits.
Image decode_bmp(std::string_view bytes, const std::string& name, const ImageLimits& limits);

}  // namespace sphparam
