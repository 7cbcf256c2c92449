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

/// The boxes of `coarse` texels over `fine` ones, coarse = max(1, ⌊fine/2⌋): each covers the same
/// length, two to three texels, and none reaches beyond the ends.
inline std::vector<BoxShares> box_shares(int fine, int coarse) {
  std::vector<BoxShares> all;
  const double size = static_cast<double>(fine) / coarse;
  for (int i = 0; i < coarse; ++i) {
    BoxShares box{static_cast<int>(i * size), {}};
    for (int k = 0; k < 4; ++k) {
      const double low = std::max(i * size, static_cast<double>(box.first + k));
      const double high = std::min((i + 1) * size, static_cast<double>(box.first + k + 1));
      const bool inside = box.first + k < fine;
      box.weights[static_cast<size_t>(k)] =
          inside ? static_cast<float>(std::max(0.0, high - low) / size) : 0;
    }
    all.push_back(box);
  }
  return all;
}

}  // namespace sphparam
