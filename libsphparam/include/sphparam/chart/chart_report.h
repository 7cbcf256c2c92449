#pragma once

#include <optional>
#include <string>

#include "sphparam/chart/spherical_chart.h"
#include "sphparam/progress.h"

namespace sphparam {

/// What became of the (u, v) chart of a map: is it certified, and what had to be split for that.
struct ChartReport {
  ChartCounts counts = {};
  ChartCertificate certificate = {};
  long vertices = 0, triangles = 0, wedges = 0;  // of the chart, splits included
  std::string not_made = {};  // why there is no chart, nor any figure of one; empty: there is one
};

/// Makes the chart and keeps its figures. The rays may have any length.
/// Returns nothing where the map is not one-to-one once its rays have unit length: no chart then.
/// Where folds need more splits than are made, the report says so and the caller goes on: whoever
/// wants figures of a chart has a map already.
/// `splits_a_vertex`: as `spherical_chart` takes it. Throws: Cancelled; std::bad_alloc.
std::optional<ChartReport> report_chart(const TriangleMesh& mesh, const SphereMap& map, int threads,
                                        const Progress& progress = {}, int splits_a_vertex = 256);

/// "chart: certified, 12 splits (2 at ±z, 9 along the meridian, 1 of folds), …" or "chart: not
/// made: …", without line end.
std::string chart_line(const std::optional<ChartReport>& chart);

}  // namespace sphparam
