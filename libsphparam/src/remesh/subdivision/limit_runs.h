#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "sphparam/remesh/limit_surface.h"

namespace sphparam {

/// Places of one patch that follow one another, as many as are evaluated side by side.
struct LimitRun {
  size_t first, count;            // of the places
  LimitPoints::Numbers s{}, t{};  // the last one's again where there are fewer
};

/// Calls visit(run) for all of them, in order.
template <class Visit>
void for_each_run(std::span<const LimitPlace> places, const Visit& visit) {
  LimitRun run{0, 0};
  for (; run.first < places.size(); run.first += run.count) {
    const auto rest = places.subspan(run.first);
    const size_t most = std::min(rest.size(), LimitPoints::count);
    run.count = 1;
    while (run.count < most && rest[run.count].patch == rest[0].patch) ++run.count;
    for (size_t i = 0; i < LimitPoints::count; ++i) {
      const LimitPlace& place = rest[std::min(i, run.count - 1)];
      run.s[i] = place.s, run.t[i] = place.t;
    }
    visit(std::as_const(run));
  }
}

}  // namespace sphparam
