#pragma once

#include <string>

#include "sphparam/render/picture.h"

namespace sphparam {

/// A small picture of a mesh, upright, and its sphere side by side in the colours of area, as the
/// bytes of a PNG, twice as wide as the `pixels` it is high. `draw_png` draws better and takes a
/// hundred times as long; here ten thousand are wanted. Requires: a map; at most 1024 pixels.
/// Ensures: the same bytes on every machine with the same zlib. Cost: 15 ms at 10,000 triangles.
std::string draw_thumbnail(const DrawnMesh& drawn, int pixels);

}  // namespace sphparam
