#pragma once

#include <string>

namespace sphparam {

/// What the refusal of a coordinate that is no finite number ends with: the way out.
std::string non_finite_advice();

}  // namespace sphparam
