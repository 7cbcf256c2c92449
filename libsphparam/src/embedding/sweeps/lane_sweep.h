#pragma once

#include "embedding/energy/image_point.h"
#include "embedding/sweeps/ring_packs.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Moves every vertex of a range of packs (one colour) by one guarded Newton step of its ring's
/// energy. No vertex is read that another one of the colour writes.
void step_packs(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                const DistortionEnergy& energy, double over_relaxation);

/// Puts the vertices of a range of packs at the normalised means of their rings, and sets lane bits
/// in `refused[pack]` where the mean is not well inside the ring; those vertices are not written.
void place_at_means(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                    unsigned char* refused);

}  // namespace sphparam
