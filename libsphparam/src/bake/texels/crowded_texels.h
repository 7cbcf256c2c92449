#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bake/bake_scene.h"
#include "bake/texels/texel_points.h"

namespace sphparam {

/// Seeds of the samples of crowded texels are taken from here on, times the texel's index.
inline constexpr std::int64_t crowded_seeds = 1 << 10;

/// Texels that hold triangles smaller than themselves, and what lies in them: points, weighted by
/// the area on the surface that each stands for. The mean of a field is then that over the part of
/// the surface which the texel shows, the best constant for it in the sense of least squares; a
/// protrusion that has shrunk to a fraction of a texel is as visible as it is large.
///
/// Where the chart is the source's own, a point is a triangle's, the centre of what the texel cuts
/// out of it in (u, v): no triangle is missed. Where points are found by direction, texels that
/// cover more than a triangle, and their neighbours in the band, get a grid of up to 8 × 8 points,
/// as many to the east and to the south as they span triangles there.
struct CrowdedTexels {
  struct Texel {
    size_t index;        // in the band
    size_t first, last;  // its points
  };
  std::vector<Texel> texels = {};
  TexelPoints points = {};
  std::vector<float> weights = {};  // a point; they sum to 1 in every texel
  std::int64_t before = 0;          // points of the band that were visited before these
};

/// Visits the crowded texels of a band in the order of their first points, some thousand points at
/// a time, so that what is worked out of them stays at hand.
/// `centres`: `finder.points(band, 0.5, 0.5)`. `calm`: all that is wanted is calm on walls (see
/// CalmWalls), so that texels whose middle a wall hides need no grid of their own. Cost: one
/// clipped polygon for each triangle and crowded texel that meet; or, by direction, a location for
/// each point of the grids.
void for_crowded_texels(const BakeScene& scene, const TexelFinder& finder, int band,
                        const TexelPoints& centres, bool calm,
                        const std::function<void(const CrowdedTexels&)>& visit);

}  // namespace sphparam
