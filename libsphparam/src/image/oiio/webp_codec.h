#pragma once

#include <optional>
#include <string_view>

#include "image/oiio_module.h"

// WebP by libwebp itself: through OpenImageIO alpha is multiplied into colours of 8 bits, and what
// it writes as lossless is not.

/// What the head of a file says. Channels: 3, or 4 with alpha.
struct WebpHead {
  int width, height, channels;
};

/// Nothing for what is no WebP file, is cut short, or is an animation.
std::optional<WebpHead> webp_head(std::string_view bytes);

/// The samples as floats, as `SphparamImageTable::decode` gives them. Throws: std::runtime_error.
void decode_webp(const WebpHead& head, std::string_view bytes, SphparamPixelRoom room);

/// As `SphparamImageTable::encode_webp`.
int encode_webp(const SphparamWebp* image, SphparamBytesSink bytes, SphparamBytesSink error);
