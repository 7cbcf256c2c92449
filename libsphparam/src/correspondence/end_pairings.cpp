#include "correspondence/end_pairings.h"

#include <algorithm>
#include <cmath>

// Depth first: every end of the first surface gets one of the second's, or none.

namespace sphparam {
namespace {

constexpr size_t least_pairs = 3;  // fewer do not fix a turn
constexpr double of_farness = 0.5, of_left_out = 0.5, of_apart = 1;

class Search {
 public:
  Search(const Extremities& from, const Extremities& to, const Eigen::MatrixXd& apart)
      : from_(from), to_(to), apart_(apart), taken_(to.vertices.size(), 0) {}

  std::vector<EndPairing> all() {
    descend(0);
    return std::move(found_);
  }

 private:
  void descend(size_t end) {
    if (end == from_.vertices.size()) {
      if (pairs_.size() >= least_pairs) found_.push_back({pairs_, cost()});
      return;
    }
    for (size_t other = 0; other < taken_.size(); ++other) {
      if (taken_[other]) continue;
      taken_[other] = 1;
      pairs_.emplace_back(static_cast<int>(end), static_cast<int>(other));
      descend(end + 1);
      pairs_.pop_back();
      taken_[other] = 0;
    }
    descend(end + 1);
  }

  double cost() const {
    double lengths = 0, farness = 0, apart = 0;
    double left = from_.prominence.sum() + to_.prominence.sum();
    const double all = left;
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const auto [a, b] = pairs_[i];
      farness += std::abs(from_.farness[a] - to_.farness[b]);
      if (apart_.size() > 0) apart += apart_(a, b);
      left -= from_.prominence[a] + to_.prominence[b];
      for (size_t j = 0; j < i; ++j)
        lengths +=
            std::abs(from_.distances(a, pairs_[j].first) - to_.distances(b, pairs_[j].second));
    }
    const double count = static_cast<double>(pairs_.size());
    return 2 * lengths / (count * (count - 1)) + of_farness * farness / count +
           of_left_out * left / all + of_apart * apart / count;
  }

  const Extremities &from_, &to_;
  const Eigen::MatrixXd& apart_;
  std::vector<char> taken_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<EndPairing> found_;
};

}  // namespace

std::vector<EndPairing> likely_pairings(const Extremities& from, const Extremities& to, int count,
                                        const Eigen::MatrixXd& apart) {
  std::vector<EndPairing> pairings = Search(from, to, apart).all();
  std::ranges::stable_sort(pairings, {}, &EndPairing::cost);
  if (std::ssize(pairings) > count) pairings.resize(static_cast<size_t>(count));
  return pairings;
}

}  // namespace sphparam
