#pragma once

#include "embedding/energy/image_point.h"
#include "embedding/sweeps/ring_packs.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Moves every vertex of a range of packs (one colour) by one guarded Newton step of its ring's
/// energy. No vertex is read that another one of the colour writes. `ring_energy`, where given,
/// gets the energy of each of these vertices' triangles before its step.
void step_packs(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                const DistortionEnergy& energy, double over_relaxation,
                float* ring_energy = nullptr);

/// All colours from a first one on, one after the other. Same bits for any number of threads.
void sweep_packs(const RingPacks& packs, int first_colour, ImagePoint* points,
                 const DistortionEnergy& energy, double over_relaxation, int threads,
                 float* ring_energy = nullptr);

/// Puts the vertices of a range of packs where they lie in their rings as the rest triangles have
/// it, and sets lane bits in `refused[pack]` where that is not well inside the ring; those vertices
/// are not written.
void place_in_rings(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                    unsigned char* refused);

}  // namespace sphparam
