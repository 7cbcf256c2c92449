#pragma once

#include <functional>

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// Settles the (u, v) of a chart on multiples of 2⁻²⁴ of a turn, which stay what they are in
/// float32 and when a file counts u or v from the other end, so that every piece is positive:
/// where rounding folds triangles, vertices around them move by as little as makes room, some
/// 1e-7 of a turn for each that crowds there. Where chords of long edges fold them, vertices move
/// with the chords.
///
/// Ensures: the same triangles, wedges and points; `counts.nudged_vertices` says how many moved by
/// more than rounding, in all, `certificate.max_shift` how far. Where no room is found, or more
/// than some thousand vertices would have to move together, the chart as it was given. Same bytes
/// for any number of threads.
/// Requires: a chart as `spherical_chart` makes it, but for folds. Our own. Cost: a few passes; 1
/// ms a triangle that rounding folds. `ask` is called on the way; what it throws ends all.
SphericalChart settled(SphericalChart chart, int threads, const std::function<void()>& ask = {});

}  // namespace sphparam
