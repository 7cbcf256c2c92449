#pragma once

#include <optional>

#include "image/oiio_module.h"

// WebP by libwebp itself: through OpenImageIO alpha is multiplied into colours of 8 bits, and what
// it writes as lossless is not.

/// What the head of a file says. Channels: 3, or 4 with alpha.
struct WebpHead {
  int width, height, channels;
};

/// Nothing for what is no WebP file, is cut short, or is an animation.
std::optional<WebpHead> webp_head(const char* bytes, size_t size);

/// The samples as floats, as `SphparamImageTable::decode` gives them.
int decode_webp(const WebpHead& head, const char* bytes, size_t size, SphparamPixelRoom room,
                void* room_context, SphparamBytesSink error, void* error_context);

/// As `SphparamImageTable::encode_webp`.
int encode_webp(const SphparamWebp* image, SphparamBytesSink bytes, void* context,
                SphparamBytesSink error, void* error_context);
