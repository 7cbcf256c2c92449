#pragma once

namespace sphparam {

/// How the numbers of an image are stored: half and float in .exr, 16-bit integers in .png.
enum class ImageDepth { Half, Float, Uint16 };

}  // namespace sphparam
