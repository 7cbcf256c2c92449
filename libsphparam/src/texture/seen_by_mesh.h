#pragma once

#include "sphparam/io/mesh_file.h"
#include "texture/read_textures.h"
#include "texture/seen_texels.h"

namespace sphparam {

/// What the faces of a file look at on the image that some of its materials have, as these place
/// it. All of it where there are no coordinates, and where many faces tile it.
/// Cost: linear in the faces and the texels.
SeenTexels seen_texels(const MeshFile& file, const ImageOrigin& image, int width, int height,
                       int threads);
/// On an image for all faces, as their own coordinates place it.
SeenTexels seen_texels(const MeshFile& file, TextureWrap wrap, int width, int height, int threads);

}  // namespace sphparam
