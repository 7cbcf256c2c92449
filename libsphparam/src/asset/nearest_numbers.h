#pragma once

#include "sphparam/asset/whole_surface.h"

namespace sphparam {

/// A wrap whose vertices have the numbers of the asset's (a potential, labels with their table):
/// those of its nearest point, mixed there, labels by the weightiest; said in a comment and in
/// `done`. What materials show, colours and normals are baked instead. Other surfaces have theirs,
/// and stay as they are. Requires: `asset` is what was wrapped. Ensures: the same for any number of
/// threads. Cost: 2 µs a vertex and the tree of a `RayScene`; nothing where there are no numbers.
WholeSurface with_nearest_numbers(WholeSurface whole, const MeshSource& asset, int threads);

}  // namespace sphparam
