#pragma once

#include "embedding/pack_kernel.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Eight triangles, one a lane; empty lanes repeat the first triangle.
struct alignas(8 * pack_width) TrianglePack {
  double inverse_base[pack_width];  // the entries of SourceTriangle
  double inverse_height[pack_width];
  double foot[pack_width];
  double area[pack_width];
  Vertex corner[3][pack_width];
  int filled;  // lanes
};

/// Gradient and projected Hessian of A f of eight triangles, in the tangent coordinates of their
/// corners' frames (`tangent_frame`).
struct alignas(8 * pack_width) TriangleTerms {
  double gradient[3][2][pack_width];
  double diagonal[3][3][pack_width];  // corner k with itself: entries 00, 01, 11
  double off[3][4]
            [pack_width];  // corner k (rows) with corner k + 1 (columns): entries 00, 01, 10, 11
};

/// Sum of A f; +∞ unless every orientation is certain to be positive.
double guarded_energy(const TrianglePack* packs, int count, const ImagePoint* points,
                      const DistortionEnergy& energy);

/// Requires: determinants positive. The Hessians are positive semidefinite.
void differentiate_triangles(const TrianglePack* packs, int count, const ImagePoint* points,
                             const DistortionEnergy& energy, TriangleTerms* terms);

}  // namespace sphparam
