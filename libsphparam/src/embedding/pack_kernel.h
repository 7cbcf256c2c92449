#pragma once

#include "embedding/ring_packs.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Eight rays or doubles at a time; plain GCC/Clang vectors, as wide as a pack on every machine.
using Lanes = double __attribute__((vector_size(8 * pack_width)));

struct alignas(8 * pack_width) LaneVectors {
  Lanes x, y, z;
};

/// Image points with one spare double, so that a point never crosses a cache line.
struct alignas(32) ImagePoint {
  double x, y, z, spare;

  Vector3 vector() const { return {x, y, z}; }
};

inline ImagePoint image_point(const Vector3& p) { return {p.x(), p.y(), p.z(), 0}; }

/// Moves every vertex of a range of packs (one colour) by one guarded Newton step of its ring's
/// energy. `scratch`: at least largest_valence entries. No vertex is read that another one of the
/// colour writes.
void step_packs(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                const DistortionEnergy& energy, double over_relaxation, LaneVectors* scratch);

/// Puts the vertices of a range of packs at the normalised means of their rings, and sets lane bits
/// in `refused[pack]` where the mean is not well inside the ring; those vertices are not written.
void place_at_means(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                    unsigned char* refused, LaneVectors* scratch);

}  // namespace sphparam
