#pragma once

#include "sphparam/curvilinear/poles.h"
#include "sphparam/mesh/fillers.h"

namespace sphparam {

/// Top and bottom of a mesh, as `poles_along` has them, each put into the middle of where it is.
/// On fillers or their rim, that is the vertex of what closes the hole that is most edges away from
/// the rim, unless both poles are at one hole. On a flat top, faces that are as high as the pole
/// but for 1e-4 of the mesh's extent, it is the vertex nearest to the middle by area of those that
/// hang together with the pole, where it is nearer by more than that: the top of a body that leans
/// is not over its middle. Ensures: poles that share no edge, else those that were given.
/// Requires: a direction of finite numbers that is not 0. Our own. Cost: some passes over the mesh.
Poles middle_poles(const TriangleMesh& mesh, const Topology& topology, const Vector3& up,
                   const FillerMarks& fillers, Poles poles);

/// Whether both poles are on the fillers of one hole, or on its rim: a surface that has its top and
/// bottom there is drawn out between them. Cost: the fillers of these holes, and to mark them.
bool poles_share_filler(const Topology& topology, const FillerMarks& fillers, Poles poles);

}  // namespace sphparam
