#pragma once

#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// What a closed mesh encloses, below 0 where its faces look inward, against the cube of the root
/// of its area: 0.094 of a ball, 0.01 of a cortex, next to nothing of a sheet. At any size; no
/// number without area. Requires: a vertex; faces name vertices that are there.
double enclosed(const TriangleMesh& mesh);

/// Of the area of a closed surface, what fillers have of it at most where inside and outside are
/// its own. A sheet is as much filler as surface: which side of it is out, its file says.
constexpr double most_filled = 0.4;

/// Whether fillers have more than that. At any size. Requires: a mark a face, or none at all; faces
/// name vertices that are there.
bool is_sheet(const TriangleMesh& mesh, const FillerMarks& fillers);

}  // namespace sphparam
