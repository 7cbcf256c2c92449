#pragma once

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// Splits every pole triangle of a chart into `wedges` ones side by side, by points that divide its
/// link edge evenly, in (u, v) and on the surface; the neighbours across are split at the same
/// points. The apex of each has a u of its own, so that a texture comes to a point in finer teeth.
///
/// The surface and, outside the caps, its (u, v) stay as they are.
/// Requires: `source` are the triangles that the chart was made of; chart.certificate.one_to_one().
/// Ensures: a chart of the same source as `spherical_chart` makes them, with a certificate of its
/// own. `wedges` ≤ 1 changes nothing.
/// Throws: std::invalid_argument where the chart is not certified, or more would be made than ints
/// can number. Our own; what it is for: a GPU draws the triangle, not the trapezoid up to v = 0.
/// Cost: one pass, the certificate, and the triangles added: 2·(wedges − 1) a pole triangle.
SphericalChart refine_poles(SphericalChart chart, const Triangles& source, int wedges,
                            int threads = 0);

}  // namespace sphparam
