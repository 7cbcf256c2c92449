// As LimitPoint::normal has them, eight at a time.

#include "displace/base_normals.h"

#include <algorithm>
#include <array>

#include "displace/unit_normals.h"
#include "remesh/subdivision/limit_runs.h"

namespace sphparam {

namespace {

using Components = std::array<LimitPoints::Numbers, 3>;

void find_unit_normals(const LimitPoints& points, Components& normals) {
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    for (size_t i = 0; i < LimitPoints::count; i += W) {
      const LimitLanes<W> of = {load<W>(points.position, i), load<W>(points.by_s, i),
                                load<W>(points.by_t, i)};
      store(unit_normals(of), normals, i);
    }
  });
}

}  // namespace

void find_normals(std::span<const LimitPlace> places, PlaceFinder& patches, LineTable& lines,
                  size_t first) {
  LimitPoints points{};
  Components normals;
  for_each_run(places, [&](const LimitRun& run) {
    patches.patch(places[run.first].patch).surface.evaluate(run.s, run.t, run.count, points);
    find_unit_normals(points, normals);
    for (size_t k = 0; k < 3; ++k) {
      std::copy_n(points.position[k].begin(), run.count, &lines.origins[k][first + run.first]);
      std::copy_n(normals[k].begin(), run.count, &lines.normals[k][first + run.first]);
    }
  });
}

}  // namespace sphparam
