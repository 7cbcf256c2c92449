#pragma once

#include <string_view>

#include "render/colour.h"
#include "sphparam/image/image.h"

namespace sphparam {

/// The size of a text, in pixels, at `scale` pixels a dot.
int text_width(std::string_view text, int scale);
int text_height(int scale);

/// Writes into a picture, (x, y) the upper left corner; what does not fit is cut off. Figures,
/// letters of English, blank and / + - . : < > _ ( ) % are known; others are left blank.
void draw_text(Image& image, std::string_view text, int x, int y, int scale, const Rgb& colour);

}  // namespace sphparam
