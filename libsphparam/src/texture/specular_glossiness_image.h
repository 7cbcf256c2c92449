#pragma once

#include "sphparam/image/image.h"
#include "sphparam/io/materials.h"

namespace sphparam {

/// The image that materials by specular colour and glossiness are in the model of glTF 2.0: base
/// colour in sRGB and alpha, or of `numbers` roughness in the second channel and metallic in the
/// third. As large as the larger one; of the other the nearest texels. Images without pixels are
/// white.
Image metallic_roughness_image(const SpecularGlossiness& said, const Image& diffuse,
                               const Image& specular, bool numbers, int threads);

}  // namespace sphparam
