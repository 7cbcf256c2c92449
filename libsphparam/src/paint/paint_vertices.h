#pragma once

#include "sphparam/image/image.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"
#include "sphparam/texture/equirectangular_image.h"

namespace sphparam {

/// The colours of the vertices under an equirectangular image: of each, the mean over its cell on
/// the sphere, the thirds of its triangles next to it, in linear light. Where texels are larger
/// than the cell that is the image at the vertex.
///
/// Returns one row of #V texels, sRGB and alpha. Requires: unit rays, one a vertex, a map that
/// `certify` calls bijective. Same values for any number of threads. Throws: Cancelled.
/// Cost: three lookups a triangle.
Image paint_vertices(const Topology& topology, const SphereMap& map,
                     const EquirectangularImage& image, const Progress& progress = {},
                     int threads = 0);

}  // namespace sphparam
