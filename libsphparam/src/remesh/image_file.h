#pragma once

#include <string>

#include "sphparam/remesh/image_depth.h"

namespace sphparam {

/// What an image is written in if nobody says: 16 bits in .png, else float.
ImageDepth usual_depth(const std::string& path);

}  // namespace sphparam
