#pragma once

#include "arguments/declaration.h"
#include "sphparam/gltf/texture_format.h"

namespace sphparam::cli {

/// --textures and --webp-quality.
void declare_textures(Declaration& command, TextureFormat& format, int& quality);

}  // namespace sphparam::cli
