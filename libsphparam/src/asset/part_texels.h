#pragma once

#include <vector>

#include "sphparam/asset/remake_asset.h"

namespace sphparam {

/// What each connected part of a surface has of the images that are baked of it, `settings.from` or
/// else the mesh itself; the one with most texels first. Found by images of at most 512 texels a
/// row. Throws: as `bake_values`. Cost: that of a bake of so many texels, where there are several.
std::vector<PartTexels> texels_of_parts(const MappedMesh& mapped, BakeSettings settings);

}  // namespace sphparam
