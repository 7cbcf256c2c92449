#pragma once

#include "pipeline/map_in_progress.h"

namespace sphparam {

/// The directions from `work.options.centre` are the map so far, with what folds there noted in
/// `work.result.radial`; a map that is made anew lies as they do. Requires: no vertex at the
/// centre.
void map_radially(MapInProgress& work);

/// Notes how far the map has the surface from these directions. Requires: `map_radially`.
void note_movement(MapInProgress& work);

/// Those that others than fillers have.
std::vector<Vertex> surface_vertices(const MapInProgress& work);

}  // namespace sphparam
