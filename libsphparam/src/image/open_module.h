#pragma once

#include <string>

#include "image/oiio_module.h"

namespace sphparam {

/// The functions of the image module, opened on first use. Throws: ImageError where it is missing.
const SphparamImageTable& image_codecs();

/// What the module has told, after `prefix`. Throws: ImageError; std::bad_alloc where memory ran
/// out, which nobody may take for a broken image.
[[noreturn]] void throw_told(const std::string& prefix, const std::string& told);

}  // namespace sphparam
