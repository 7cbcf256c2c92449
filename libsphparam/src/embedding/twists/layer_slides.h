#pragma once

#include <vector>

#include "embedding/energy/image_point.h"
#include "embedding/twists/limb_search.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Lets the layers of a limb slide round it, each vertex to the image of another one of its layer,
/// where between two layers that lowers the energy. What a limb's map is twisted by is often one
/// vertex between any two layers, all along it: nothing that moves as one piece turns that back, as
/// layers near each other do not have their images on circles. Returns between how many layers it
/// slid. Our own.
///
/// Requires: as `untwist`. Ensures: what is in no layer stays; where layers slid, the energy has
/// fallen, and every determinant is certainly positive. Cost: O(#V of the limb).
int slide_layers(const Topology& topology, const RestTriangles& source,
                 const DistortionEnergy& energy, const Limb& limb, std::vector<ImagePoint>& image);

}  // namespace sphparam
