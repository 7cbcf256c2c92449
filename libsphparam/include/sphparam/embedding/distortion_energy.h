#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// One rest (reference) triangle, laid into the plane with corner 0 at the origin and corner 1 on
/// the x axis. Scaled so that the whole source has area 4π, as the sphere has.
///
/// Our own: inverse edge lengths instead of cotangents. The squared norm of the Jacobian becomes a
/// sum of squares that no rounding makes negative, however bad the triangle.
struct RestTriangle {
  double area;
  double inverse_base;    // 1 / |v1 − v0|
  double inverse_height;  // 1 / height of v2 above v0 v1
  double foot;            // the foot of that height is v0 + foot·(v1 − v0)
};

/// All rest triangles. 32 bytes a triangle.
using RestTriangles = std::vector<RestTriangle>;

/// Measures the source. Triangles with less than 1e-9 of the mean area (coincident corners,
/// collinear corners) count as equilateral ones of that size.
/// Ensures: all entries finite and, but for `foot`, positive; Σ area = 4π up to the floors.
/// Requires: finite positions.
RestTriangles measure_source(const TriangleMesh& mesh, int threads = 0);

/// The same triangle, its corners renumbered so that `corner` comes first.
RestTriangle rotated(const RestTriangle& triangle, int corner);

/// The same triangle in a source scaled to `factor` times the area.
RestTriangle scaled(const RestTriangle& triangle, double factor);

/// What the energies know of the map of one triangle with image points x0, x1, x2 on the sphere:
/// d = ½‖J‖² of the map to the chord triangle, s = det(x0, x1, x2) / 2A. At an isometry of a small
/// triangle d = s = 1; s is zero exactly at a flip.
struct TriangleDistortion {
  double d;
  double s;
};

enum class EnergyKind {
  AngleAndArea,        // f = (d + λ(s² + 1)/2) / s: MIPS plus λ times a symmetric area term
  SymmetricDirichlet,  // f = d (1 + 1/s²)
};

/// E = Σ A f(d, s) over all triangles, A the source area. +∞ when a triangle is folded or flat.
///
/// With ε > 0, the divisor s becomes χ_ε(s) = (s + √(s² + ε²))/2 > 0, so that E is finite and
/// smooth on folded maps too; as ε → 0 it tends to E.
/// Paper: the angle term is Hormann and Greiner 2000 (MIPS); χ_ε Garanzha et al., "Foldover-free
/// maps in 50 lines of code" (2021); det(x0, x1, x2) in place of the chord area our own: the chord
/// triangle has no barrier where the spherical triangle degenerates.
struct DistortionEnergy {
  EnergyKind kind = EnergyKind::AngleAndArea;
  double lambda = 1;    // area against angle, 0 to `greatest_lambda`: conformal to equal-area
  double epsilon = 0;   // from 0, finite; above 0: regularised, so another map; no record tells it
  double pressure = 0;  // finite, in no record; times the image's area of what `optimise` presses
};

/// Beyond these weights of area against angle doubles forget one of the two.
constexpr double least_lambda = 1e-10, greatest_lambda = 1e6;

/// f and its derivatives; f is linear in d.
struct EnergyDerivatives {
  double f, f_d, f_s, f_ds, f_ss;
};

/// Requires: s > 0 or ε > 0.
inline EnergyDerivatives differentiate(const DistortionEnergy& energy, double d, double s) {
  // χ, χ' and χ''; the second form of χ does not cancel where s is negative.
  double chi = s, chi1 = 1, chi2 = 0;
  if (energy.epsilon > 0) {
    const double e2 = energy.epsilon * energy.epsilon, root = std::sqrt(s * s + e2);
    chi = s > 0 ? (s + root) / 2 : e2 / (2 * (root - s));
    chi1 = chi / root;
    chi2 = e2 / (2 * root * root * root);
  }
  const double i = 1 / chi, lambda = energy.lambda;
  if (energy.kind == EnergyKind::SymmetricDirichlet) {  // f = d (1 + χ⁻²)
    return {d * (1 + i * i), 1 + i * i, -2 * d * chi1 * i * i * i, -2 * chi1 * i * i * i,
            2 * d * (3 * chi1 * chi1 * i - chi2) * i * i * i};
  }
  const double n = d + lambda * (s * s + 1) / 2;  // f = n / χ
  return {n * i, i, (lambda * s - n * chi1 * i) * i, -chi1 * i * i,
          (lambda - (2 * lambda * s * chi1 + n * chi2) * i + 2 * n * chi1 * chi1 * i * i) * i};
}

/// f alone; +∞ where it is not defined.
inline double energy_density(const DistortionEnergy& energy, double d, double s) {
  if (!(s > 0) && !(energy.epsilon > 0)) return std::numeric_limits<double>::infinity();
  return differentiate(energy, d, s).f;
}

/// Corner points of an image triangle, in the order of the rest triangle's corners.
using ImageTriangle = std::array<Vector3, 3>;

/// How an image triangle differs from its rest triangle: what the densities above take.
TriangleDistortion distortion(const RestTriangle& source, const ImageTriangle& image);

/// Two unit vectors that make (u, v, x) a right-handed orthonormal frame.
struct TangentFrame {
  Vector3 u, v;

  /// The point of the sphere that lies at tangent coordinates (a, b): x + a u + b v, normalised.
  Vector3 at(const Vector3& x, double a, double b) const {
    return (x + a * u + b * v).normalized();
  }
};

/// A frame at the unit vector x. Paper: Duff et al., "Building an orthonormal basis, revisited"
/// (2017); no branch depends on anything but the sign of z.
inline TangentFrame tangent_frame(const Vector3& x) {
  const double sign = std::copysign(1.0, x.z());
  const double a = -1 / (sign + x.z()), b = x.x() * x.y() * a;
  return {{1 + sign * x.x() * x.x() * a, sign * b, -sign * x.x()},
          {b, sign + x.y() * x.y() * a, -x.y()}};
}

/// A·f of one triangle and its exact derivatives in the tangent coordinates (a0 b0 a1 b1 a2 b2) of
/// the three frames, taken at the frames' origins. The Hessian is symmetric, not definite.
struct TriangleEnergy {
  double value;
  Eigen::Matrix<double, 6, 1, Eigen::DontAlign> gradient;
  Eigen::Matrix<double, 6, 6, Eigen::DontAlign> hessian;
};

/// Requires: the frames belong to the image points; energy finite there.
TriangleEnergy triangle_energy(const DistortionEnergy& energy, const RestTriangle& source,
                               const ImageTriangle& image,
                               const std::array<TangentFrame, 3>& frames);

/// Σ A f over all triangles; 4π(1 + λ) is the value for an isometry, which triangles that are not
/// small do not reach. Same bits for any number of threads.
double distortion_energy(const Topology& topology, const RestTriangles& source,
                         const SphereMap& map, const DistortionEnergy& energy, int threads = 0);

}  // namespace sphparam
