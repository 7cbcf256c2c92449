#pragma once

#include <span>

#include "sphere/planar_orientation.h"
#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// Is a chart `one_to_one` with these (u, v) instead of its own? The answer of its certificate,
/// which asks nothing else then: not where the points lie, nor how far (u, v) are from theirs, nor,
/// where the chart is certified with its own, what does not depend on them. Requires: a chart that
/// is not wrapped; its certificate is of its triangles and wedges, or none.
/// Cost: a fifth of a certificate.
bool is_one_to_one(const SphericalChart& chart, const TextureCoordinates& uv, int threads = 0);

/// As `certify_chart`, for who has asked already where the rays of the first points are in (u, v):
/// `chart_points` of them. Cost: four fifths.
ChartCertificate certify_chart(const SphericalChart& chart, std::span<const ChartPoint> places,
                               int threads);

}  // namespace sphparam
