#pragma once

#include "bake/surface_field.h"
#include "sphparam/mesh/fillers.h"

namespace sphparam {

/// The field with coverage: as a last channel, or, where colours have alpha already, as a factor of
/// that. Values stay what they are on fillers too, so that filters near a boundary find no black.
/// Requires: marks, one a face of the source.
SurfaceField with_coverage(SurfaceField field, const FillerMarks& fillers);

}  // namespace sphparam
