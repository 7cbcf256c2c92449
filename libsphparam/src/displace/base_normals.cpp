// As LimitPoint::normal has them, eight at a time.

#include "displace/base_normals.h"

#include <algorithm>
#include <array>

#include "lanes.h"
#include "remesh/subdivision/limit_runs.h"

namespace sphparam {

namespace {

using Components = std::array<LimitPoints::Numbers, 3>;

void unit_normals(const LimitPoints& points, Components& normals) {
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    for (size_t i = 0; i < LimitPoints::count; i += W) {
      const LaneVectors<W> across = cross(load<W>(points.by_s, i), load<W>(points.by_t, i));
      const Lanes<W> length = root(dot(across, across)), none = 0.0;
      const LaneMask<W> has_normal = length > 0.0;
      store(select(has_normal, across.x / length, none), &normals[0][i]);
      store(select(has_normal, across.y / length, none), &normals[1][i]);
      store(select(has_normal, across.z / length, none), &normals[2][i]);
    }
  });
}

}  // namespace

void find_normals(std::span<const LimitPlace> places, PlaceFinder& patches, LineTable& lines) {
  LimitPoints points{};
  Components normals;
  for_each_run(places, [&](const LimitRun& run) {
    patches.patch(places[run.first].patch).surface.evaluate(run.s, run.t, run.count, points);
    unit_normals(points, normals);
    for (size_t k = 0; k < 3; ++k) {
      std::copy_n(points.position[k].begin(), run.count, &lines.origins[k][run.first]);
      std::copy_n(normals[k].begin(), run.count, &lines.normals[k][run.first]);
    }
  });
}

}  // namespace sphparam
