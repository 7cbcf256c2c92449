#pragma once

#include <optional>
#include <string>

#include "sphparam/chart/spherical_chart.h"

namespace sphparam::tools {

/// What became of the (u, v) chart of a map: is it certified, and what had to be split for that.
struct ChartReport {
  ChartCounts counts;
  ChartCertificate certificate;
  long vertices = 0, triangles = 0, wedges = 0;  // of the chart, splits included
};

/// Makes the chart and keeps its figures. The rays may have any length.
/// Returns nothing where the map is not one-to-one once its rays have unit length: no chart then.
std::optional<ChartReport> report_chart(const TriangleMesh& mesh, const SphereMap& map,
                                        int threads);

/// "chart: certified, 12 splits (2 at ±z, 9 along the meridian, 1 of folds), …" without line end.
std::string chart_line(const std::optional<ChartReport>& chart);

}  // namespace sphparam::tools
