#pragma once

#include "bake/map_kinds.h"

namespace sphparam {

/// The colour of the source: its texture through its own texture coordinates, filtered as the
/// options ask for; without textures the colours of its vertices. Three channels, or four where a
/// texture has alpha.
/// Throws: MapError where there are no colours, or textures without texture coordinates.
SurfaceField make_base_colour(const BakeScene& scene, const std::string&);

}  // namespace sphparam
