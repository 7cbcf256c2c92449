#pragma once

#include <vector>

#include "embedding/frame/landmarks.h"

namespace sphparam {

/// Throws: std::invalid_argument where a pin is no vertex or at no point of the sphere, or a vertex
/// has two.
void require_pins(const std::vector<Pin>& pins, int vertex_count);

}  // namespace sphparam
