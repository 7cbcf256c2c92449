#pragma once

#include "sphparam/io/materials.h"

namespace sphparam {

/// Takes the image from a texture of a material, which keeps its factors; without
/// that of its light it is dark, for the factor alone would make all of it shine. `channels`: those
/// of the material.
void leave_out_image(MaterialTexture& texture, const MaterialChannels& channels);

}  // namespace sphparam
