#pragma once

#include "image/oiio_module.h"

namespace sphparam {

/// The functions of the image module, opened on first use. Throws: ImageError where it is missing.
const SphparamImageTable& image_codecs();

}  // namespace sphparam
