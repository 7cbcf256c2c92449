#pragma once

#include <vector>

#include "embedding/energy/image_point.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Mean |log2 (Ω / A)|, weighted by source area: Ω is the solid angle of the image triangle.
double area_error(const Topology& topology, const RestTriangles& source,
                  const std::vector<ImagePoint>& image, int threads);

/// Mean |log2 (det / 2Ω)|, weighted by source area: what the energy takes for the area of an image
/// triangle is less than its solid angle where it is large.
double determinant_error(const Topology& topology, const RestTriangles& source,
                         const std::vector<ImagePoint>& image, int threads);

/// The rest triangles with areas for which s = det / 2A is 1 where the solid angle of an image
/// triangle of this size and shape is the area of the source. A determinant is less than twice the
/// solid angle: by next to nothing where triangles are small, by a third for those of an
/// icosahedron. Shapes stay. Requires: positive determinants. Cost: one pass. Our own.
RestTriangles aimed_at_solid_angles(const Topology& topology, RestTriangles source,
                                    const std::vector<ImagePoint>& image, int threads);

}  // namespace sphparam
