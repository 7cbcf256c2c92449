#pragma once

namespace sphparam {

/// How a texel of a baked image finds its point of the surface.
enum class Interpolation {
  Uv,      // linear in (u, v) on the triangles of the chart, as a GPU does
  Sphere,  // by the direction of the texel, on the geodesic map: for other spheres
};

}  // namespace sphparam
