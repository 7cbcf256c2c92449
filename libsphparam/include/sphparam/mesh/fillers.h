#pragma once

#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

// A mesh with holes has a map only when these are closed. Faces that do no more than that are
// fillers: a map is proved with them, and whatever shows or measures the surface leaves them out.
// They are marked by 1 in a list of one number a face; an empty list: there are none.
using FillerMarks = std::vector<unsigned char>;

/// The triangles that are surface, with all vertices under their numbers.
/// Requires: a mark a face, or none at all. Cost: one pass.
TriangleMesh surface_of(const TriangleMesh& mesh, const FillerMarks& fillers);

/// The same, but that faces keep their numbers too: fillers become points, each a corner of the
/// surface. For rays, which meet no point, and for nearest points. Requires: also some surface.
TriangleMesh surface_in_place(const TriangleMesh& mesh, const FillerMarks& fillers);

}  // namespace sphparam
