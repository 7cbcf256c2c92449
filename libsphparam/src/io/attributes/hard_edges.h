#pragma once

#include <optional>

#include "sphparam/chart/spherical_chart.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Gives a chart the hard edges of its mesh: where a file has normals at corners and those of one
/// wedge differ, as float32, each normal gets a wedge of its own. (u, v) and triangles stay; new
/// wedges follow the others. So what was certified of the chart still holds.
///
/// Returns the unit normals of the wedges, #W×3, as `tangent_frame` takes them; nothing, and the
/// chart stays, where the file has no normals at corners: `shading_normals` are those of its
/// vertices then. A corner's normal that is zero or not finite is taken from there too.
/// Requires: `file` is the mesh that the chart was made of. Whoever bakes in the tangent frame of a
/// chart and whoever writes one must both come through here. Cost: one pass over the corners.
std::optional<Points> split_at_hard_edges(SphericalChart& chart, const MeshFile& file,
                                          int threads = 0);

}  // namespace sphparam
