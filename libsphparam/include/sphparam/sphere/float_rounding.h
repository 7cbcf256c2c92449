#pragma once

#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// A map that a file of float32 coordinates can hold, and what rounding did to it.
struct FloatRounding {
  SphereMap map;            // every coordinate is a float32 number, every ray as long as the radius
  Certificate certificate;  // of `map`: the only thing that may call it one-to-one
  long bad_before = 0;      // triangles with det ≤ 0 when every coordinate is rounded to nearest
  long bad_after = 0;       // triangles with det ≤ 0 in `map`
  long moved = 0;           // vertices that are elsewhere than at their nearest floats
};

/// Rounds a map, on a sphere of the given radius, to float32 and mends what rounding breaks.
///
/// Triangles lower than the spacing of floats may fold. Their vertices are nudged by up to 8 ulp
/// where that makes all their triangles positive; where whole aggregates fell together, the
/// vertices of triangles too low for float32 are first moved apart in double, never folding a
/// triangle, and rounded again. Everything else keeps its nearest floats. A map that is folded
/// already is rounded and nothing more. Requires: one unit ray a vertex, up to rounding; a radius
/// from 1e-6 to 1e6, so that no coordinate that matters is near the ends of float32. Ensures: `map`
/// has rays of that length, up to rounding, and equals its own float32 image; same bytes for any
/// number of threads. Throws: std::invalid_argument for another radius, and for another number of
/// rays. Cost: two passes; where something breaks, a few hundred visits of the vertices around it.
/// Our own: what is certified in double is not in float32 (a cap shrunk by 1e-6 loses hundreds of
/// triangles).
FloatRounding round_to_float(const Topology& topology, const SphereMap& map, int threads = 0,
                             double radius = 1);

}  // namespace sphparam
