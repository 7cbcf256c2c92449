#pragma once

#include <optional>
#include <string_view>

#include "image/image_codec.h"
#include "sphparam/texture/convention.h"

namespace sphparam {

/// Which map an image was baked on: how many rays, and a hash of them.
constexpr std::string_view rays_text = "sphparam:rays";

/// The text that an image's metadata has below this name of ours; empty: not there. JPEG and TIFF
/// hold ours in one text, a line each.
std::string_view baked_text(const ImageTexts& texts, std::string_view key);

/// Whether an image says that it was baked of what is measured, in its own unit (heights in
/// floats): integers are scaled to what there is.
bool is_measured(const ImageTexts& texts);

/// The convention that an image says it was baked in; nothing for images of strangers.
std::optional<Convention> baked_convention_of(const ImageTexts& texts);

}  // namespace sphparam
