#include "gltf/export_chart.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "chart/one_to_one.h"
#include "chart/settle.h"
#include "gltf/stored_chart.h"
#include "sphparam/chart/refine_poles.h"

// A convention has u = turns·u₀ + offset. The chart of the map turned by θ ↦ θ + 2πr has
// u₀ + r modulo 1: r = offset where turns is 1; where it is −1, 1 − (u₀ + r) with r = −offset.

namespace sphparam {
namespace {

/// θ grows by a number of right angles: signs and places of coordinates change, nothing is rounded.
SphereMap turned(SphereMap map, int quarters) {
  for (int i = 0; i < quarters; ++i) {
    const VectorX x = map.points.col(0);
    map.points.col(0) = -map.points.col(1);
    map.points.col(1) = x;
  }
  return map;
}

bool holds_in_float32(const ExportChart& chart, bool upwards, int threads) {
  const UvStorage storage{.mirrored = chart.mirrored, .upwards = upwards};
  return is_one_to_one(chart.chart, read_uv(stored_uv(chart.chart, storage), storage), threads);
}

}  // namespace

ExportChart export_chart(const TriangleMesh& mesh, const Topology& topology, const SphereMap& map,
                         const ExportChartOptions& options) {
  if (options.keep_topology && options.refine_poles > 1)
    throw std::invalid_argument("refined poles need new vertices");
  const ConventionInfo& info = info_of(options.convention);
  const int quarters = (4 + info.turns * static_cast<int>(std::lround(4 * info.offset))) % 4;
  const std::optional<SphereMap> copy =
      quarters > 0 ? std::optional(turned(map, quarters)) : std::nullopt;
  const SphereMap& aligned = copy ? *copy : map;
  ExportChart result;
  if (options.keep_topology)
    result.chart = wrapped_chart(mesh, topology, aligned, options.threads);
  else if (options.made && !copy)
    result.chart = *options.made;
  else
    result.chart = spherical_chart(mesh, topology, aligned, options.threads, options.progress);
  if (options.refine_poles > 1 && result.chart.certificate.one_to_one()) {
    result.chart = refine_poles(std::move(result.chart), mesh.triangles, options.refine_poles,
                                options.threads);
  }
  result.mirrored = info.turns < 0;
  if (result.chart.certificate.one_to_one() &&
      !holds_in_float32(result, options.upward_v, options.threads))
    result.chart = settled(std::move(result.chart), options.threads);
  result.theta_offset = -quarters * std::numbers::pi / 2;
  return result;
}

}  // namespace sphparam
