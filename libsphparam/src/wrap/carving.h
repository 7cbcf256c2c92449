#pragma once

#include <vector>

#include "sphparam/progress.h"
#include "wrap/solid.h"

namespace sphparam {

/// Whether a point can change sides without a change of the topology of either: by the bits of
/// those of its fourteen neighbours (`Lattice::strides`) that are solid.
bool is_simple(unsigned solid_neighbours);

/// A solid that is a ball, and has all points of `kept`: carved out of the lattice from its faces
/// inwards, the points with the largest values first, each only where it is simple. What is left
/// besides: walls across the holes of `kept`, and bridges between its parts, one point thick.
/// Ensures: deterministic. Cost: about 0.1 µs a point of the lattice.
Solid carve_ball(const Lattice& lattice, const std::vector<float>& field, const Solid& kept,
                 const Progress& progress);

}  // namespace sphparam
