#pragma once

#include "sphparam/gltf/export.h"

namespace sphparam {

/// Makes the images of a look what `options.textures` says, and notes what became of each.
///
/// As WebP, base colour and emission lose what `options.webp_quality` says, unless they are smaller
/// without loss, and alpha is kept. Normals, occlusion, roughness and metallic lose nothing: an
/// error there is seen as light, and what WebP calls chroma has half the resolution, by which a
/// normal map would be off by 5° in the mean. An image that would not become smaller stays as it
/// is; so does one beyond what WebP can hold, which is a warning, as are 16 bits that become 8.
/// Ensures: the same bytes for any number of threads. Throws: ImageError.
/// Cost: as WebP some 1 s a megatexel.
void encode_textures(Look& look, const LookOptions& options, int threads);

}  // namespace sphparam
