#pragma once

#include "bake/field_registry.h"

namespace sphparam {

/// The colour of the source: its texture through its own texture coordinates, filtered as the
/// options ask for; without textures the colours of its vertices. Three channels, or four where a
/// texture has alpha.
/// Throws: NoColoursError; FieldError for textures without texture coordinates.
SurfaceField make_base_colour(const BakeScene& scene, const std::string&);

}  // namespace sphparam
