#pragma once

#include "sphparam/gltf/asset.h"

namespace sphparam {

/// Moves places that are one as 16-bit integers, and not as floats, into cells beside theirs where
/// nothing is: who welds what is at one place would find triangles without corners and surfaces
/// that touch. Ensures: one of them stays, bounds are what they were, copies of a place move
/// together. Returns how many places found no room. Cost: linear but for sorting.
long set_apart(FloatRows& positions);

}  // namespace sphparam
