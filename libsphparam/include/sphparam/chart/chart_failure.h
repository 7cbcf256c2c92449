#pragma once

#include <string>

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// Why a chart is not one-to-one though its map is: "its map is one-to-one, but thinner in (u, v)
/// than doubles can tell: 12 triangles fold there".
std::string chart_failure(const SphericalChart& chart);

/// Of a chart whose `counts.at_limit` is set: how many folds take how many splits.
std::string split_limit_reached(const SphericalChart& chart);

/// Throws NotCertifiedError, "NAME: " and `chart_failure`, unless the chart is one-to-one: nothing
/// can be baked for it, as texels would have two owners.
void require_one_to_one(const SphericalChart& chart, const std::string& name);

}  // namespace sphparam
