#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace sphparam {

/// The label of the largest total weight, the lowest of several: what linear interpolation is to
/// numbers, this is to labels. Takes pairs (label, weight), at least one, and sorts them.
inline double weightiest_label(std::span<std::pair<double, double>> labelled) {
  std::ranges::sort(labelled);
  double best = labelled.front().first, best_weight = -1;
  for (size_t e = 0; e < labelled.size();) {
    const double label = labelled[e].first;
    double weight = 0;
    for (; e < labelled.size() && labelled[e].first == label; ++e) weight += labelled[e].second;
    if (weight > best_weight) std::tie(best, best_weight) = std::tie(label, weight);
  }
  return best;
}

}  // namespace sphparam
