#pragma once

#include <utility>
#include <vector>

#include "correspondence/extremities.h"

namespace sphparam {

/// Ends of one surface paired with ends of another, by their numbers.
struct EndPairing {
  std::vector<std::pair<int, int>> pairs;
  double cost = 0;  // how unlike the lengths are that the surfaces have; 0: alike
};

/// The `count` most likely pairings of at least three ends, those of least cost first. Lengths know
/// no sides: a pairing costs as much as its mirror image, unless `apart`, in √area, says how far
/// each end of `from` is in space from each of `to`. Cost: factorial, 10 ms for seven ends.
std::vector<EndPairing> likely_pairings(const Extremities& from, const Extremities& to, int count,
                                        const Eigen::MatrixXd& apart = {});

}  // namespace sphparam
