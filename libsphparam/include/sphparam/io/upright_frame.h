#pragma once

#include <string>

#include "sphparam/io/sphere_file.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/parameterize.h"

namespace sphparam {

/// The options of a map that stands as its mesh does: its poles are the top and the bottom
/// (`poles_along`), in the middle of a flat one and of the options' fillers, where these close a
/// hole there; θ = 0 is its front (`vertex_along`). Poles and a meridian that the options have
/// already stay. Requires: `topology` is of the mesh. Cost: some passes over the mesh.
ParameterizeOptions with_upright_frame(ParameterizeOptions options, const TriangleMesh& mesh,
                                       const Topology& topology, const UprightAxes& axes);

/// Where a map has such a frame, exactly: "y, front z", the value of "upright" among the lines of
/// its provenance; else empty. Requires: unit rays. Cost: as above.
std::string upright_words(const SphereMap& map, const TriangleMesh& mesh, const Topology& topology,
                          const UprightAxes& axes, const FillerMarks& fillers = {});

/// Whether the lines on a map, which a file has too, say that it stands as these axes do.
bool map_is_upright(const Provenance& lines, const UprightAxes& axes);
bool map_is_upright(const MeshFile& file, const UprightAxes& axes);

}  // namespace sphparam
