#pragma once

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/fillers.h"

namespace sphparam {

/// Files mark fillers by this property of faces: 1 for a filler, 0 for surface.
inline constexpr char filler_property[] = "filler";

/// The marks of a file; empty where it has none, none is set, or nothing would be surface.
FillerMarks fillers_of(const MeshFile& file);

/// Writes the marks down; empty: takes the property away. Requires: one a face, or none at all.
void mark_fillers(MeshFile& file, const FillerMarks& fillers);

/// The surface alone, with all that its file carries but the mark, and without vertices that only
/// fillers use. A file without fillers is returned as it is.
MeshFile without_fillers(const MeshFile& file);

}  // namespace sphparam
