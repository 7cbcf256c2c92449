#pragma once

#include "sphparam/correspondence/carried_shape.h"
#include "sphparam/gltf/export.h"

namespace sphparam {

/// A match to be looked at: the first surface, with an animation that turns it into the shape of
/// the second one and back. The triangles are those of the first, split for its chart, so that any
/// equirectangular image of either map sits right; the normals of the second shape are its own.
///
/// Looks that come of a mesh's own textures or colours are materials named by it: that of the first
/// (or a checker, where it has none) and that of the second, which comes first where the first one
/// has none. Extras tell where the second
/// was put: position there = scale · rotation · position in its file + shift.
/// Of `options`: as `make_asset` for the first; what it says of `morph`, `others` and `coarser`
/// does not count. Throws: as `make_asset`; UnmeasurableMesh where a surface has no area.
/// Cost: as `make_asset`.
Asset make_morph(const SurfaceMap& map, Placement placement = Placement::Scaled,
                 ExportOptions options = {});

}  // namespace sphparam
