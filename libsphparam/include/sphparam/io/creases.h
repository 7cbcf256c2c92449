#pragma once

#include <optional>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Gives a mesh without normals of its own (STL, CAD) hard edges, as `corner_normals`: all that is
/// drawn, baked and written of it goes by these. An edge is hard whose two faces turn by more than
/// so many degrees, and one that has not two faces of one orientation, or is the rim of a filler.
/// The corners about a vertex that no hard edge parts share the mean of their faces' normals,
/// weighted by angle, so that it does not depend on the triangles that a flat face is cut into. At
/// a vertex that no hard edge parts it is that of `shading_normals`, and where there is no other,
/// the file stays as it is. Faces without area take the normal of a neighbour.
///
/// Returns how many edges between two faces are hard; nothing, and the file stays, where it has
/// normals: they say what is hard. Angles that differ by less than 0.001° count as equal, for
/// coordinates are rounded to float32. Throws: std::invalid_argument unless 0 ≤ degrees ≤ 180.
/// Requires: finite positions. Cost: a sort of the edges.
std::optional<long> add_creases(MeshFile& file, double degrees);

}  // namespace sphparam
