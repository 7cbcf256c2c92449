#pragma once

#include <cstdint>

#include "displace/directed_base.h"
#include "sphparam/image/image.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

struct DisplacementOptions {
  int width = 4096, height = 2048;
  int threads = 0;
  Progress progress = {};
};

/// How far a surface is from a base, in every direction.
///
/// The image is equirectangular: column c and row r are the direction θ = 2π(c + ½)/width,
/// ϕ = π(r + ½)/height. It holds the signed distance, in units of the mesh, from the base's point
/// with that direction (see `DirectedBase`) along the unit normal of its limit surface, outwards,
/// to the surface: base + displacement · normal.
///
/// To use it elsewhere: subdivide the control mesh by its scheme, smooth the texture coordinates
/// u = θ/2π, v = ϕ/π (row 0 north) with it, displace along the normal by the value with scale 1 and
/// midlevel 0. Coordinates that are interpolated in straight lines over faces are off by about an
/// eighth of the square of a face's size in radians; near the poles by more.
struct Displacement {
  Image image;  // one channel
  double least = 0, greatest = 0;
  // How texels came by their values.
  std::int64_t walked = 0, cast = 0;  // a point of the surface on the normal
  std::int64_t missed = 0;            // none near by: where the normal comes nearest to the surface
  std::int64_t inexact = 0;           // whose place on the base is that of the flat grid
};

constexpr std::int64_t most_texels = std::int64_t{1} << 28;

/// The displacement from a base to a mapped mesh.
/// Requires: unit rays, certified one-to-one; width and height from 1, at most `most_texels`.
/// Throws: Cancelled. Ensures: the same bytes for any number of threads. Cost: some 0.3 µs a texel.
Displacement make_displacement(const DirectedBase& base, const TriangleMesh& mesh,
                               const Topology& topology, const SphereMap& map,
                               const DisplacementOptions& options = {});

}  // namespace sphparam
