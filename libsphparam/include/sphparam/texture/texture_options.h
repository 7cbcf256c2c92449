#pragma once

namespace sphparam {

/// What a texture says outside [0, 1].
enum class TextureWrap { Repeat, Mirror, Clamp };

/// How a texture is magnified.
enum class TextureFilter { Nearest, Bilinear, Bicubic };

}  // namespace sphparam
