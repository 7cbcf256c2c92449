#pragma once

#include <filesystem>
#include <vector>

#include "image/oiio_module.h"

namespace sphparam {

/// The functions of the image module, opened on first use. Throws: ImageError where it is missing.
const SphparamImageTable& image_codecs();

/// Where the module may be, in the order in which it is looked for: in the folder that the
/// environment's SPHPARAM_MODULES names; about the running program; about the shared library that
/// this code is in. What nobody knows is left out; where no folder has it, the loader is asked.
std::vector<std::filesystem::path> module_folders();

}  // namespace sphparam
