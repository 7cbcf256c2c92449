#pragma once

#include <OpenImageIO/imageio.h>

#include <string_view>

#include "image/oiio_module.h"

namespace sphparam {

/// Decodes a file in memory with the named decoder; `text` may take nothing.
/// Throws: std::exception that says why not; there may be pixels by then.
void decode_in_memory(const char* format, std::string_view bytes, SphparamImageLimits limits,
                      SphparamPixelRoom room, SphparamTextSink text);

/// The texts of a file's metadata.
void tell_texts(const OIIO::ImageSpec& spec, SphparamTextSink text);

}  // namespace sphparam
