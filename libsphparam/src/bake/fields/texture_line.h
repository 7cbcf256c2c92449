#pragma once

#include "bake/surface_field.h"
#include "sphparam/io/mesh_file.h"
#include "texture/texture_pyramid.h"
#include "texture/texture_seams.h"

namespace sphparam {

/// Where the samples of a run look a texture up that lies so on the mesh's texture coordinates, a
/// row a corner. Without coordinates they all look at one place.
TextureLine texture_line(const SurfaceRun& run, const SeamedTexcoords& texcoords,
                         const TexturePlacement& placement);

}  // namespace sphparam
