#pragma once

#include <functional>
#include <optional>

#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Values of k functions at points, one point a row; or their coefficients, one basis function a
/// row, (L + 1)² of them: Y_lm in row l² + l + m, −l ≤ m ≤ l.
using Functions = RowTable<double, Eigen::Dynamic>;

/// The row of Y_lm.
constexpr int harmonic_index(int l, int m) { return l * l + l + m; }

/// Greatest degree: beyond it the recursion would leave the range of doubles near the poles.
constexpr int greatest_harmonic_degree = 1000;

/// Values at directions of functions that are given by coefficients, #P×k.
///
/// The basis is real and orthonormal on the unit sphere, without the Condon–Shortley phase:
///   Y_l0 = N_l0 P_l(cosϕ),  Y_lm = √2 N_lm P_l^m(cosϕ) cos mθ,  Y_l,−m = √2 N_lm P_l^m(cosϕ) sin
///   mθ, N_lm² = (2l + 1)/4π · (l − m)!/(l + m)!,  P_l^m = (1 − x²)^{m/2} dᵐP_l/dxᵐ;
/// so that x, y, z are √(4π/3) times Y_11, Y_1,−1, Y_10.
/// Requires: unit directions, up to float32's rounding; (L + 1)² rows of coefficients, 0 ≤ L ≤
/// greatest_harmonic_degree. Throws: std::invalid_argument if not. Cost: (1 + k) (L + 1)²
/// multiplications a point. Source: the recursion of normalised Legendre functions: Holmes and
/// Featherstone, "A unified approach to the Clenshaw summation …" (2002).
Functions synthesise(const Functions& coefficients, const Points& directions, int threads = 0);

/// Σ_i weights_i · values_i · Y(direction_i), (L + 1)²×k: where the weights are those of a
/// quadrature, the coefficients; else the transpose of `synthesise`. Same requirements and cost.
/// Ensures: same bits for any number of threads.
Functions analyse(int degree, const Points& directions, const VectorX& weights,
                  const Functions& values, int threads = 0);

/// A Gauss–Legendre grid that integrates products of two functions of degree L exactly: (L + 1) ×
/// (2L + 2) directions, row by row from the north, and their weights, which sum to 4π.
struct QuadratureGrid {
  Points directions;
  VectorX weights;
};
/// The grid of degree L ≥ 0. Cost: O(L²).
QuadratureGrid quadrature_grid(int degree);

struct HarmonicFitOptions {
  int degree = 20;
  /// Least squares at the vertices, weighted by their share of the sphere; else by quadrature: the
  /// projection of what is between the vertices, too, whatever the degree wanted.
  bool least_squares = true;
  int most_iterations = 100;  // ≥ 0: of conjugate gradients
  double tolerance = 1e-12;   // 0 to 1: of their residual, relative to the right-hand side's; what
                              // is rounding of the function itself does, too
  /// The k functions anywhere on the surface, equal to the values at vertices; linear on each
  /// triangle of the map where it is empty.
  std::function<VectorX(const SurfacePoint&)> between = {};
  int threads = 0;
  Progress progress = {};
};

struct HarmonicFit {
  Functions coefficients;  // (L + 1)²×k
  VectorX rms;  // k: of what is left at the vertices, weighted by their share of the sphere
  int iterations = 0;

  // Of least squares: whether conjugate gradients came to their tolerance. Where not, or where
  // there are more coefficients than vertices, the vertices leave something open: then also the
  // greatest degree up to which a fit has no such trouble, and by how much the coefficients of a
  // degree up to there are other ones than that fit's, of their size: the most of all.
  bool converged = true;
  std::optional<int> decided_degree = {};
  std::optional<double> decided_change = {};

  // Of quadrature, not of least squares: the degree of the grid of its nodes, and by how much the
  // coefficients changed when it was doubled last, of √∫(f − mean)² (the function where it is
  // most; nothing where the degree wanted is the greatest there is).
  int quadrature_degree = 0;
  std::optional<double> quadrature_change = {};
};

/// Nodes are doubled until the coefficients change by no more than this, or the grid's degree is
/// greatest_harmonic_degree.
constexpr double settled_quadrature = 1e-4;

/// Expands k functions of a mesh's vertices, #V×k, in spherical harmonics on its map.
///
/// Least squares start from the quadrature's coefficients, and end where a step would change the
/// functions between the vertices √10 times as much as at them and leave at them what was there: so
/// where vertices leave something open (large triangles, great degrees) the quadrature decides.
/// Ensures: functions that are harmonics of degree ≤ L at the vertices are found up to rounding
/// where the vertices determine them; same bits for any number of threads. Requires: a map that
/// `certify` calls bijective, unit rays. Throws: std::invalid_argument for wrong sizes or options,
/// or NaN; Cancelled. Cost: two transforms of #V points an iteration, few where triangles are small
/// beside a wave, and log₂ L such fits where something is open; quadrature: a transform and a
/// location of #F nodes, one of four times as many, and so on until they agree
/// (`settled_quadrature`), 2 million nodes at most. Source: least squares: Brechbühler, Gerig and
/// Kübler (1995), Section 4; conjugate gradients, their start and their end: our own.
HarmonicFit fit_harmonics(const Topology& topology, const SphereMap& map, const Functions& values,
                          const HarmonicFitOptions& options = {});

/// Coefficients of the functions on the sphere as it is turned by R: g(u) = f(Rᵀu).
/// Requires: RᵀR = 1 up to rounding, det R = 1. Ensures: exact up to rounding; power per degree
/// stays. Throws: std::invalid_argument as `synthesise`. Cost: 2 (L + 1)² points of it, twice.
/// Source: values on a grid of quadrature, turned back: it integrates them exactly.
Functions turn_harmonics(const Functions& coefficients, const Eigen::Matrix3d& rotation,
                         int threads = 0);

/// Σ_m c_lm² per degree and function, (L + 1)×k.
Functions power_per_degree(const Functions& coefficients);

/// Semi-axes of the ellipsoid that the degree-1 part of three functions x, y, z describes,
/// descending. Requires: 3 columns, degree ≥ 1. Throws: std::invalid_argument if not.
Vector3 first_order_ellipsoid(const Functions& coefficients);

}  // namespace sphparam
