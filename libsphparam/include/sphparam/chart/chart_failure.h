#pragma once

#include <string>

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// Why a chart is not one-to-one though its map is: "its map is one-to-one, but thinner in (u, v)
/// than doubles can tell: 12 triangles fold there".
std::string chart_failure(const SphericalChart& chart);

/// Of a chart that is one-to-one because vertices were moved in (u, v): "where triangles are
/// thinner than (u, v) can tell, 1.2 % of its vertices moved there, by up to 3e-05 of a turn".
/// Empty: none by more than the rounding of float32. `vertices`: of the chart.
std::string moved_vertices(const ChartCounts& counts, const ChartCertificate& certificate,
                           long vertices);
std::string moved_vertices(const SphericalChart& chart);

/// Of a chart whose `counts.at_limit` is set: how many folds take how many splits.
std::string split_limit_reached(const SphericalChart& chart);

/// Throws NotCertifiedError, "NAME: " and `chart_failure`, unless the chart is one-to-one: nothing
/// can be baked for it, as texels would have two owners.
void require_one_to_one(const SphericalChart& chart, const std::string& name);

}  // namespace sphparam
