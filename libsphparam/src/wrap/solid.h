#pragma once

#include <cstdint>
#include <vector>

#include "wrap/lattice.h"

namespace sphparam {

/// Which points of a lattice belong to a solid: 1, else 0. Those on the lattice's faces do not.
using Solid = std::vector<std::uint8_t>;

/// All that the outside does not reach, from the faces of the lattice along points whose value is
/// more than 0. `hollows`: of each piece of such points that it does not reach, which are solid
/// too, the first.
Solid surrounded(const Lattice& lattice, const std::vector<float>& field,
                 std::vector<std::int64_t>& hollows);

/// Which share of a solid lies where the value is more than 0: of what `surrounded` says, the
/// hollows. 0 of none.
double hollow_share(const std::vector<float>& field, const Solid& solid);

/// The sizes in points of the solid's connected parts, in the order of their first points.
std::vector<std::int64_t> parts_of(const Lattice& lattice, const Solid& solid);

/// All but the largest part taken away; of equal ones the first stays.
void keep_largest(const Lattice& lattice, Solid& solid);

/// Vertices − edges + triangles − tetrahedra, of those all of whose corners belong to the solid. A
/// part without cavities adds 1, less its handles.
std::int64_t euler_characteristic(const Lattice& lattice, const Solid& solid);

}  // namespace sphparam
