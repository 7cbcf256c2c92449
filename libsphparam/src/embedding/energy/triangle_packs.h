#pragma once

#include <array>

#include "embedding/energy/image_point.h"
#include "lanes.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Eight triangles, one a lane. What the energy needs of a RestTriangle, in floats: as if the
/// source had been rounded. The area is 1 / (2 inverse_base inverse_height).
struct alignas(8 * pack_width) TrianglePack {
  float inverse_base[pack_width];  // negative where the triangle is pressed
  float inverse_height[pack_width];
  float foot[pack_width];
  Vertex corner[3][pack_width];
};

/// Which Hessian of a triangle. Projected ones (shape_projection.h) are positive semidefinite, but
/// leave out terms that stay at a minimum: steps by them end in halves of what is left. By the
/// exact ones a step leaves next to nothing near a minimum, and is worth little far from one.
enum class Curvature { Projected, Exact };

/// Gradient and Hessian of A f of eight triangles, in the tangent coordinates of their corners'
/// frames (`tangent_frame`).
struct alignas(8 * pack_width) TriangleTerms {
  double gradient[3][2][pack_width];
  double diagonal[3][3][pack_width];  // corner k with itself: entries 00, 01, 11
  double off[3][4][pack_width];       // corner k (rows) with corner k + 1 (columns): 00, 01, 10, 11
};

/// Puts a triangle into a lane.
void fill_lane(const RestTriangle& source, const std::array<Vertex, 3>& corners, int lane,
               TrianglePack& pack);

/// The triangle in a lane feels the energy's pressure.
inline void press_lane(int lane, TrianglePack& pack) {
  pack.inverse_base[lane] = -pack.inverse_base[lane];
}

/// Sum of A f of the first `count` triangles; +∞ unless the orientation of every one, of the rest
/// of the last pack too, is certain to be positive.
double guarded_energy(const TrianglePack* packs, int count, const ImagePoint* points,
                      const DistortionEnergy& energy);

/// Of `count` packs. Requires: determinants positive.
void differentiate_triangles(const TrianglePack* packs, int count, const ImagePoint* points,
                             const DistortionEnergy& energy, Curvature curvature,
                             TriangleTerms* terms);

}  // namespace sphparam
