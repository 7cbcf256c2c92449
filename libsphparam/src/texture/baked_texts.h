#pragma once

#include <optional>
#include <string_view>

#include "image/image_codec.h"
#include "sphparam/texture/convention.h"

namespace sphparam {

/// Which map an image was baked on: how many rays, and a hash of them.
constexpr std::string_view rays_text = "sphparam:rays";

/// What a sample is in an image's file, as reading it tells beside the texts of its metadata:
/// "uint8", "uint16", "half", "float" and so on; absent of BMP, TGA and WebP, which have 8 bits.
constexpr std::string_view samples_text = "sphparam:samples";

/// Whether the samples are floats: colours are linear light then, as OpenImageIO and Blender have
/// it; in integers they are sRGB.
bool has_float_samples(const ImageTexts& texts);

/// The text that an image's metadata has below this name of ours; empty: not there. JPEG and TIFF
/// hold ours in one text, a line each.
std::string_view baked_text(const ImageTexts& texts, std::string_view key);

/// Whether an image says that it was baked of what is measured, in its own unit (heights in
/// floats): integers are scaled to what there is.
bool is_measured(const ImageTexts& texts);

/// The convention that an image says it was baked in; nothing for images of strangers.
std::optional<Convention> baked_convention_of(const ImageTexts& texts);

}  // namespace sphparam
