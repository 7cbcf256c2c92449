#include "embedding/newton/outlook.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

// By projected Hessians gains shrink by a factor, which is known from the gains so far. In long
// valleys good steps and poor ones take turns: pairs are compared, where there are two. By exact
// ones what a whole step leaves is less than what it gained.

namespace sphparam {
namespace {

constexpr double least_ratio = 0.5, greatest_ratio = 0.9;  // of a gain to the one before
constexpr double idle_share = 0.1;     // of what may be left: a step that gains less is idle
constexpr int most_idle_steps = 3;     // in a row
constexpr double near_minimum = 3e-3;  // of the energy: what a step promises there, at most
constexpr double hardly_cut = 0.5;     // of a Newton step

double expected(const std::vector<double>& gains) {
  const size_t n = gains.size();
  const auto pair = [&](size_t last) { return (gains[last] + gains[last - 1]) / 2; };
  double gain = gains.back(), ratio = n > 1 ? gain / gains[n - 2] : 0;
  if (n > 3) {
    gain = pair(n - 1);
    ratio = std::sqrt(gain / pair(n - 3));
  }
  if (!(ratio <= greatest_ratio)) ratio = greatest_ratio;
  ratio = std::max(ratio, least_ratio);
  return gain * std::max(ratio / (1 - ratio), n > 1 ? static_cast<double>(n) : 0.0);
}

}  // namespace

void Outlook::note(const GlobalNewton::Step& made, double before, double after) {
  const double gain = 1 - after / before, promised = std::min(1.0, made.decrement / before);
  if (gains_.empty()) first_gain_ = std::max(gain, promised);
  gains_.push_back(gain);
  const bool exact = made.curvature == Curvature::Exact;
  const double to_come = exact && made.complete && made.length >= 1 ? gain : expected(gains_);
  // A step cut short has left most of what it promised.
  left_ = std::min(1.0, std::max(to_come, (1 - std::min(1.0, made.length)) * promised));
  idle_ = gain < rest_ * idle_share ? idle_ + 1 : 0;
  const bool near = exact ? made.complete && made.length >= hardly_cut : promised < near_minimum;
  next_ = near ? Curvature::Exact : Curvature::Projected;
}

bool Outlook::settled() const { return !(left_ >= rest_) || idle_ == most_idle_steps; }

}  // namespace sphparam
