#pragma once

#include <vector>

#include "embedding/energy/image_point.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Turns what lies beyond a ring of few vertices round a limb by whole vertices, wherever that
/// lowers the energy: where a limb has three to twelve vertices around, its map may be twisted
/// by one of them between two rings, or between any two all along it, and no step that goes
/// downhill turns it back. Returns how many rings it turned. Our own.
///
/// Ensures: the energy falls, or nothing is changed; every determinant stays certainly positive.
/// Requires: every determinant certain to be positive; no vertex is pinned.
/// Cost: O(#V log #V), about 1 µs a vertex.
int untwist(const Topology& topology, const RestTriangles& source, const DistortionEnergy& energy,
            std::vector<ImagePoint>& image);

}  // namespace sphparam
