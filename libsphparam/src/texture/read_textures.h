#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "texture/source_texture.h"

namespace sphparam {

/// A texture of the user's own for all of the mesh.
/// Throws: ImageError.
SourceTexture read_texture(const std::string& path, TextureWrap wrap, int threads);

/// The textures of a file's materials, decoded; empty where it has none. An image that several
/// materials use is decoded once.
/// Throws: ImageError that names material and image, for one that is missing, broken or unusable.
std::vector<SourceTexture> read_textures(const MeshFile& file, int threads);

}  // namespace sphparam
