#pragma once

#include <optional>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A mesh divided by a power of two, which changes no bit of any mantissa.
struct Rescaled {
  TriangleMesh mesh;  // at about unit size
  int exponent;       // the given one is 2^exponent times as large
};

/// If squares of the positions could overflow or vanish; nothing if they are fine.
std::optional<Rescaled> at_unit_size(const TriangleMesh& mesh);

}  // namespace sphparam
