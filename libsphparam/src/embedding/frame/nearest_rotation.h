#pragma once

#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// The rotation R with least Σ w |R from − to|² over the rows.
/// Requires: as many rows in all three; weights of 0 or more.
/// Ensures: det R = 1, also where a mirror image would fit better; same bits for any number of
/// threads. Paper: Kabsch, "A solution for the best rotation to relate two sets of vectors" (1976).
Eigen::Matrix3d nearest_rotation(const Points& from, const Points& to, const VectorX& weights);

/// The same for any sum Σ w to·fromᵀ: the rotation R with the greatest trace of Rᵀ times it.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& covariance);

/// The map with every ray turned, of unit length up to rounding. It may fold what is nearly flat.
SphereMap turned(const SphereMap& map, const Eigen::Matrix3d& rotation);

/// Root of the mean square of the angles between the rays of two maps, by these weights; radians.
/// Requires: as many rays in both as weights, none of them 0, whose sum is above 0.
double rms_angle(const SphereMap& a, const SphereMap& b, const VectorX& weights);

}  // namespace sphparam
