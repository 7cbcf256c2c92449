#pragma once

#include "bake/field_registry.h"

namespace sphparam {

/// The source's normal, unit, in the mesh's own axes: that of its corners or vertices, linear
/// between them, turned by the normal maps of its materials (`SourceNormal`).
SurfaceField make_object_normal(const BakeScene& scene, const std::string&);

/// The source's normal in the tangent frame of the target's chart: the coordinates (x, y, z) of
/// x T + y B + z N, made unit, with T and N as a viewer interpolates them (linear between wedges,
/// not made unit) and B = w · N × T: see chart/tangent_frame.h. T goes with growing u of the image,
/// so for mirrored conventions x changes its sign; y goes north, or south if `normal_y_down`.
SurfaceField make_tangent_normal(const BakeScene& scene, const std::string&);

}  // namespace sphparam
