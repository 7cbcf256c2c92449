#pragma once

#include <optional>
#include <string>

#include "sphparam/remesh/image_depth.h"

namespace sphparam {

/// "half", "float", "u16": the words of options and of what images say of themselves.
const char* name_of(ImageDepth depth);

/// What an image is written in: as asked for; if nobody says, 16 bits in .png, else float.
/// Throws: std::invalid_argument for a name that is neither .png nor .exr, and for one whose format
/// does not hold what is asked for: what is under a name is what the name says.
ImageDepth depth_in(const std::string& path, std::optional<ImageDepth> wanted);

}  // namespace sphparam
