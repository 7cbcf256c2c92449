#pragma once

#include <vector>

#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Points of a sphere as the Connectome Workbench has them before it compares spheres: those of the
/// file, in numbers of 32 bits, scaled to the radius 100 in such numbers. Rays may have any length:
/// those of unit length that were made of a file of radius 100 or 1 are found again in it.
using Float32Points = RowTable<float, 3>;
Float32Points at_radius_100(const Points& rays);

/// The points of a sphere's flat triangles nearest to others, as Workbench finds them, in numbers
/// of 32 bits: where two triangles are about as near, its rounding decides which of them it is, and
/// whether the place is inside, on a side or a corner, so which corners have no weight at all.
///
/// Rule (facts of SignedDistanceHelper of the Connectome Workbench 1.5, in our own words): a point
/// is brought into the plane of a triangle along the first side and across it; inside, its place is
/// there, else on the nearest side or corner; that place, rounded, is what the distance is to. The
/// least distance wins, the lowest face of several. Weights are areas seen from the rounded place,
/// on a side the share along it.
/// `located`: where rays meet the triangles, from where the place is a few triangles at most.
/// Cost: some 2 µs a point.
std::vector<SurfacePoint> nearest_in_float32(const Topology& topology, const Float32Points& sphere,
                                             const Float32Points& points,
                                             std::vector<SurfacePoint> located, int threads = 0);

}  // namespace sphparam
