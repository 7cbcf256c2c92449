#pragma once

#include <optional>

#include "sphparam/chart/spherical_chart.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"
#include "sphparam/texture/convention.h"

namespace sphparam {

struct ExportChartOptions {
  Convention convention = Convention::Sphparam;
  int refine_poles = 1;        // wedges a pole triangle
  bool keep_topology = false;  // no new vertices, so that triangles may fold
  bool upward_v = false;       // float32 is to hold (u, 1 − v)
  int threads = 0;
  Progress progress = {};                // of the chart
  const SphericalChart* made = nullptr;  // of the map, where it is at hand already
};

/// A chart whose u runs from 0 to 1 in a convention, not at θ = 0: the map is turned by quarters
/// first, exactly. Where the convention mirrors u, the chart still runs east, and whoever writes it
/// stores 1 − u.
struct ExportChart {
  SphericalChart chart;
  // Of `split_at_hard_edges`, #W×3, by whoever knows the mesh's file; else vertices have one each.
  std::optional<Points> wedge_normals = std::nullopt;
  bool mirrored = false;
  double theta_offset = 0;  // θ of the chart's u = 0, radians
};

/// Requires: a certified map of unit rays. Throws: std::invalid_argument if `refine_poles` and
/// `keep_topology` are both wanted; Cancelled.
ExportChart export_chart(const TriangleMesh& mesh, const Topology& topology, const SphereMap& map,
                         const ExportChartOptions& options = {});

}  // namespace sphparam
