#pragma once

#include <optional>

#include "image/image_codec.h"

namespace sphparam {

/// What an image says of the chart that it was baked for, as texts of its metadata. Texels belong
/// to the triangles of one chart: on another one, with triangles at the poles cut otherwise, they
/// would stand on the wrong ones there. `pole_wedges`: as `refine_poles` takes them.
ImageTexts texts_of_chart(bool linear_in_uv, int pole_wedges);

/// Into how many wedges the pole triangles are cut of the chart that an image was baked for;
/// nothing for images that suit any chart: those of strangers, and those baked by direction.
/// `texts`: all of the file's metadata.
std::optional<int> pole_wedges_of(const ImageTexts& texts);

}  // namespace sphparam
