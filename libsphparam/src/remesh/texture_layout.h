#pragma once

#include "sphparam/remesh/texture_layout.h"

namespace sphparam {

/// The grid of a mesh. Throws: std::invalid_argument for one that has no layout in an image.
GridSpec spec_with_layout(const Remeshed& mesh);

}  // namespace sphparam
