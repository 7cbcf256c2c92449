// A row's places by Newton, as many side by side as are expected on one patch: from a good start
// one step is enough. Where steps lead out of the patch, or fail, each place is searched alone.

#include "displace/place_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "displace/direction_step.h"

namespace sphparam {

namespace {

using Numbers = LimitPoints::Numbers;

constexpr int most_steps = 3;  // side by side, before each goes its own way
constexpr double last_step = PlaceFinder::last_step(true);

struct Steps {
  Numbers s, t, det, ahead;

  /// In parameters; infinite where there is none.
  double length(size_t i) const {
    const double sum = std::abs(s[i]) + std::abs(t[i]);
    return det[i] > 0 && ahead[i] > 0 && sum <= PlaceFinder::longest_step
               ? sum
               : std::numeric_limits<double>::infinity();
  }
};

using Components = std::array<Numbers, 3>;

void step_towards(const Components& q, const LimitPoints& d, Steps& steps) {
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    for (size_t i = 0; i < LimitPoints::count; i += W) {
      const auto step = direction_step(load<W>(d.position, i), load<W>(d.by_s, i),
                                       load<W>(d.by_t, i), load<W>(q, i));
      store(step.s, &steps.s[i]);
      store(step.t, &steps.t[i]);
      store(step.det, &steps.det[i]);
      store(step.ahead, &steps.ahead[i]);
    }
  });
}

Components side_by_side(const LimitRun& run, const Points& directions) {
  Components q;
  for (size_t i = 0; i < LimitPoints::count; ++i) {
    const auto row = static_cast<Eigen::Index>(run.first + std::min(i, run.count - 1));
    for (int k = 0; k < 3; ++k) q[static_cast<size_t>(k)][i] = directions(row, k);
  }
  return q;
}

/// Newton's steps of a run at once; how long the last one of each was.
Numbers newton(const LimitPatch& direction, const Components& q, LimitRun& run) {
  Numbers length;
  LimitPoints d;
  Steps steps;
  double longest = std::numeric_limits<double>::infinity();
  for (int taken = 0; taken < most_steps && longest >= last_step; ++taken) {
    direction.evaluate(run.s, run.t, run.count, d);
    step_towards(q, d, steps);
    longest = 0;
    for (size_t i = 0; i < LimitPoints::count; ++i) {
      length[i] = steps.length(i);
      longest = std::max(longest, length[i]);
      if (std::isinf(length[i])) continue;
      run.s[i] += steps.s[i], run.t[i] += steps.t[i];
    }
  }
  return length;
}

}  // namespace

/// As if rows went on in straight lines, on the patch where that is.
LimitPlace PlaceRows::expected(size_t column) const {
  const PatchNet& net = finder_.base().net();
  LimitPlace place = above_[column];
  if (const LimitPlace& before = two_above_[column]; before.patch == place.patch) {
    place.s += place.s - before.s;
    place.t += place.t - before.t;
  }
  if (net.beyond(place) > PlaceFinder::edge_rounding) place = net.cross(place);
  return place;
}

void PlaceRows::put(size_t column, const PlaceFinder::Found& found) {
  places_[column] = found.place;
  exact_[column] = found.exact;
}

void PlaceRows::find_next(const Points& directions) {
  const auto count = static_cast<size_t>(directions.rows());
  std::swap(two_above_, above_);
  std::swap(above_, places_);
  places_.resize(count);
  exact_.resize(count);
  if (above_.empty()) {
    finder_.start_anew();
    for (size_t c = 0; c < count; ++c)
      put(c, finder_.find(directions.row(static_cast<Eigen::Index>(c))));
    return;
  }
  if (two_above_.empty()) two_above_ = above_;
  for (size_t c = 0; c < count; ++c) places_[c] = expected(c);
  for_each_run(places_, [&](const LimitRun& run) { settle(run, directions); });
}

void PlaceRows::settle(const LimitRun& expected, const Points& directions) {
  const PatchNet& net = finder_.base().net();
  const int patch = places_[expected.first].patch;
  const LimitPatch& direction = finder_.patch(patch).direction;
  LimitRun run = expected;
  Numbers length;
  length.fill(std::numeric_limits<double>::infinity());
  if (direction.is_polynomial()) length = newton(direction, side_by_side(run, directions), run);
  for (size_t i = 0; i < run.count; ++i) {
    const LimitPlace place{patch, run.s[i], run.t[i]};
    const size_t column = run.first + i;
    const double beyond = net.beyond(place);
    if (length[i] < last_step && beyond <= PlaceFinder::edge_rounding)
      put(column, {beyond > 0 ? clamped(place, net.degree()) : place, true});
    else
      put(column, finder_.find(directions.row(static_cast<Eigen::Index>(column)), place));
  }
}

}  // namespace sphparam
