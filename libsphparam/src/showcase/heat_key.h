#pragma once

#include <string>

#include "render/heat.h"

namespace sphparam {

/// The scale of a heat map as markup for a page: a bar of its colours, its numbers below.
std::string heat_key(Heat heat);

}  // namespace sphparam
