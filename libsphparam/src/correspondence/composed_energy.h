#pragma once

#include <Eigen/Core>
#include <array>

#include "correspondence/target_surface.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// The linear map of a rest triangle to a triangle in space: the images of the plane's unit
/// vectors.
struct Jacobian {
  Vector3 x, y;
};

/// Corner points in space, in the order of the rest triangle's corners.
Jacobian jacobian(const RestTriangle& rest, const ImageTriangle& image);

/// What is minimised: a density of the map from flat triangle to flat triangle on the target, with
/// s their ratio of areas, which has no sign; and, for the sign, `barrier` times MIPS, d/s, of the
/// map to the sphere. The energy's ε keeps the first finite where the image in space has no area
/// though that on the sphere has; d grows by χ_ε(s) − s with it, so that d ≥ s stays d ≥ χ, and a
/// triangle that shrinks to a point costs the more the smaller it is.
struct ComposedEnergy {
  DistortionEnergy energy = {.kind = EnergyKind::SymmetricDirichlet, .epsilon = 0.03};
  double barrier = 0.03;
};

/// The places of a triangle's corners.
using Places3 = std::array<const Place*, 3>;

/// A·f of one triangle; +∞ where its determinant on the sphere is not positive.
double composed_energy(const ComposedEnergy& energy, const RestTriangle& rest,
                       const Places3& places);

/// The same with its derivatives in the ways (u0 v0 u1 v1 u2 v2) of the three places.
struct ComposedTerms {
  double value;
  Eigen::Matrix<double, 6, 1, Eigen::DontAlign> gradient;
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> hessian;  // not definite; without what bends
};

/// Requires: a finite energy.
ComposedTerms composed_terms(const ComposedEnergy& energy, const RestTriangle& rest,
                             const Places3& places);

}  // namespace sphparam
