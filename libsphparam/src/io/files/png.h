#pragma once

#include <string>
#include <string_view>

namespace sphparam {

/// Pixels of three bytes, row by row, as a PNG. Loading OpenImageIO for it takes longer than a map.
/// Requires: 3 · width · height bytes.
std::string png_bytes(std::string_view pixels, int width, int height);

}  // namespace sphparam
