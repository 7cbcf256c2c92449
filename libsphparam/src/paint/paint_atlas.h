#pragma once

#include "sphparam/io/mesh_file.h"
#include "sphparam/paint/paint.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// `paint_atlas` of a mesh and its map. Requires: unit rays, a map that `certify` calls bijective;
/// options within their domains.
PaintedAtlas paint_atlas(const MeshFile& file, const SphereMap& map,
                         const EquirectangularImage& image, const AtlasOptions& options);

}  // namespace sphparam
