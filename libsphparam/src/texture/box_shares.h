#pragma once

#include <algorithm>
#include <array>
#include <vector>

namespace sphparam {

/// What a coarse texel takes of the fine ones: of those from `first` on, these shares of its mean.
struct BoxShares {
  int first;
  std::array<float, 4> weights;  // sum to 1
};

/// How much of a side lies before a place of it, both in [0, 1].
using Measure = double (*)(double place);

/// The boxes of `coarse` texels over `fine` ones, coarse = max(1, ⌊fine/2⌋): each covers the same
/// length, two to three texels, and none reaches beyond the ends. Shares are by length, or by the
/// measure.
inline std::vector<BoxShares> box_shares(int fine, int coarse, Measure measure = nullptr) {
  std::vector<BoxShares> all;
  const double size = static_cast<double>(fine) / coarse;
  for (int i = 0; i < coarse; ++i) {
    BoxShares box{static_cast<int>(i * size), {}};
    const auto between = [&](double low, double high) {
      return measure ? measure(high / fine) - measure(low / fine) : high - low;
    };
    const double whole = measure ? between(i * size, (i + 1) * size) : size;
    for (int k = 0; k < 4; ++k) {
      const double low = std::max(i * size, static_cast<double>(box.first + k));
      const double high = std::min((i + 1) * size, static_cast<double>(box.first + k + 1));
      const bool inside = box.first + k < fine;
      box.weights[static_cast<size_t>(k)] =
          inside && high > low ? static_cast<float>(between(low, high) / whole) : 0;
    }
    all.push_back(box);
  }
  return all;
}

}  // namespace sphparam
