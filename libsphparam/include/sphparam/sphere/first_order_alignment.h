#pragma once

#include <string>
#include <vector>

#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// How a surface and the sphere of its map are turned so that both lie along the axes of the
/// first-order ellipsoid, which is what harmonics of degree 1 make of the sphere.
///
/// In the turned sphere's directions u and the turned surface's coordinates x, the first order is
///   x = (−a u_x, −b u_y, c u_z),  a ≥ b ≥ c its semi-axes,
/// so that x = 0, y = 0, z = 0 of both are the ellipsoid's planes, and, in the functions of
/// SPHARM-PDM, whose phase makes up for the two minus signs, the first-order coefficients are
/// positive and no others but three.
struct FirstOrderAlignment {
  Eigen::Matrix3d sphere;  // rotation: a direction u of the map becomes sphere · u
  Eigen::Matrix3d object;  // rotation: a position p becomes object · (p − centre)
  Vector3 centre;          // mean of the positions over the sphere
  Vector3 semi_axes;       // a, b, c
  /// Of the turned coordinates x, y, z over the sphere, by all degrees: ∫x³ / (∫x²)^{3/2} · √4π.
  Vector3 skewness;
  /// The first order turns the sphere inside out; then x = (−a u_x, −b u_y, −c u_z).
  bool reversed = false;
  /// How far coefficients would be from what they are, of their size, with signs that are not told
  /// from these: by skewness (below 0.01), or by the template; 0: all are told apart.
  double undecided = 0;
  /// With a template: 1 − the distance of the nearest half turn to it over that of the next that
  /// makes a difference. Below 0.1 the template hardly tells them apart: skewness decides, if it
  /// can.
  double confidence = 1;
  bool by_skewness = true;  // what decided the half turn; else the template
};

/// The alignment of three functions x, y, z on a sphere, given by coefficients.
///
/// Axes are known but for a half turn about each, four choices in all. With `flips`, coefficients
/// that are aligned already (the sphere too), that of least distance to them is taken, both scaled
/// to ellipsoids of one volume. Else that which makes positive the two greatest of the three
/// |skewness|: a surface reaches farther to where x (y, z) is positive. So it is, too, where others
/// are as good as near to `flips` (`confidence` below 0.1) and skewness decides: a surface then
/// lies by its skewness as `flips` does by its own, or, where that is not clear, as without
/// `flips`. Ensures: the same coefficients, up to rounding, for a surface that is moved and turned,
/// and for a map that is turned, where a > b > c and the signs are decided. Requires: degree ≥ 1;
/// columns 0, 1, 2 are x, y, z. Throws: std::invalid_argument if not, and where `flips` are not
/// aligned. Cost: that of turning coefficients, five times. Source: Brechbühler, Gerig and Kübler
/// (1995), Section 5; axes and signs of the first order as the code of SPHARM-PDM has them (Styner
/// et al., "Framework for the statistical shape analysis of brain structures using SPHARM-PDM",
/// 2006), which also tries mirror images for `flips`; skewness: our own.
FirstOrderAlignment first_order_alignment(const Functions& coefficients,
                                          const Functions* flips = nullptr, int threads = 0);

/// The coefficients on the turned sphere, and, with `object`, of the turned surface: columns 0, 1
/// and 2 are its x, y, z; others are scalars.
Functions aligned(const Functions& coefficients, const FirstOrderAlignment& alignment, bool object,
                  int threads = 0);

/// For people: axes that are as good as equal, signs that skewness leaves open, a first order that
/// is inside out.
std::vector<std::string> doubts_about(const FirstOrderAlignment& alignment);

}  // namespace sphparam
