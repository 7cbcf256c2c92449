#pragma once

#include <optional>

#include "remesh/sphere_grid.h"

namespace sphparam {

/// The grid so many halvings of edges coarser, a quarter of the faces each: its vertices are the
/// first ones of the finer grid's, bit for bit, and the finer grid's face f lies in its face f/4.
/// Nothing where there is no such grid: for `ico:L`, and for `octa:N` with (N − 1)/2 and `cube:N`
/// with N a power of two, there are as many as the edges can be halved; for others none.
std::optional<GridSpec> coarser_grid(const GridSpec& spec, int halvings);

}  // namespace sphparam
