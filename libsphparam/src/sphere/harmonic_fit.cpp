#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "option_domain.h"
#include "sphere/harmonic_degree.h"
#include "sphere/harmonic_least_squares.h"
#include "sphere/solid_angle.h"
#include "sphparam/sphere/sphere_locator.h"
#include "sphparam/sphere/spherical_harmonics.h"

// First the projection by quadrature of the functions that the map carries to the sphere; then,
// with the vertices' shares of the sphere as weights, least squares from there. Where the integral
// is what is wanted, the nodes are as many as the triangles ask for, whatever the degree: few nodes
// take what changes between them for a long wave.

namespace sphparam {
namespace {

/// The functions that a map carries to the sphere, each times its scale.
class Carried {
 public:
  Carried(const Topology& topology, const SphereMap& map, const Functions& values,
          const VectorX& scales, const HarmonicFitOptions& options)
      : topology_(topology),
        locator_(topology, map, options.threads),
        values_(values),
        scales_(scales),
        options_(options) {}

  Functions at(const Points& directions) const {
    const std::vector<SurfacePoint> points = locator_.locate_all(directions, options_.threads);
    Functions result = Functions::Zero(directions.rows(), values_.cols());
    for (size_t i = 0; i < points.size(); ++i) {
      add(points[i], result.row(static_cast<Eigen::Index>(i)));
    }
    return result * scales_.asDiagonal();
  }

 private:
  void add(const SurfacePoint& point, Functions::RowXpr row) const {
    if (options_.between) {
      row += options_.between(point).transpose();
      return;
    }
    for (int k = 0; k < 3; ++k) {
      row += point.barycentric[k] * values_.row(topology_.vertex(point.face, k));
    }
  }

  const Topology& topology_;
  SphereLocator locator_;
  const Functions& values_;
  const VectorX& scales_;
  const HarmonicFitOptions& options_;
};

struct Integral {
  Functions coefficients;
  VectorX spread;  // of each function: √∫(f − mean)²
};

/// By the nodes of a grid of at least the degree wanted.
Integral integrate(const Carried& carried, int grid_degree, const HarmonicFitOptions& options) {
  report(options.progress, "quadrature", 0);
  const QuadratureGrid grid = quadrature_grid(grid_degree);
  const Functions f = carried.at(grid.directions);
  const auto mean = (grid.weights.transpose() * f / (4 * std::numbers::pi)).eval();
  return {analyse(options.degree, grid.directions, grid.weights, f, options.threads),
          (grid.weights.transpose() * (f.rowwise() - mean).cwiseAbs2()).cwiseSqrt().transpose()};
}

/// Of the function whose coefficients differ most, but for those that are constant.
double largest_change(const Integral& before, const Integral& now) {
  constexpr double rounding = 1e-12;
  double largest = 0;
  for (Eigen::Index k = 0; k < now.spread.size(); ++k) {
    const double change = (now.coefficients.col(k) - before.coefficients.col(k)).norm();
    if (change <= rounding * now.coefficients.col(k).norm()) continue;
    largest = std::max(largest, change / now.spread[k]);
  }
  return largest;
}

/// About as many nodes as triangles, then twice as many rows and columns until that changes
/// nothing that counts.
void integrate_until_settled(const Carried& carried, int face_count,
                             const HarmonicFitOptions& options, HarmonicFit& fit) {
  const double of_mesh = std::ceil(std::sqrt(0.5 * face_count));
  int degree =
      std::max(options.degree, static_cast<int>(std::min(of_mesh, 0.5 * greatest_harmonic_degree)));
  Integral found = integrate(carried, degree, options);
  while (degree < greatest_harmonic_degree) {
    degree = std::min(std::max(2 * degree, 1), greatest_harmonic_degree);
    Integral finer = integrate(carried, degree, options);
    fit.quadrature_change = largest_change(found, finer);
    found = std::move(finer);
    if (*fit.quadrature_change <= settled_quadrature) break;
  }
  fit.quadrature_degree = degree;
  fit.coefficients = std::move(found.coefficients);
}

void require_values(const Functions& values) {
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    for (Eigen::Index v = 0; v < values.rows(); ++v) {
      if (std::isfinite(values(v, k))) continue;
      throw std::invalid_argument("spherical harmonics: the value of function " +
                                  std::to_string(k) + " at vertex " + std::to_string(v) +
                                  " is no finite number");
    }
  }
}

/// Powers of two, one a function, that bring its largest value to between 1 and 2: no square of
/// what is counted then overflows or vanishes, and nothing is rounded.
VectorX scales_of(const Functions& values) {
  VectorX scales = VectorX::Ones(values.cols());
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const double largest = values.col(k).cwiseAbs().maxCoeff();
    if (largest > 0) scales[k] = std::ldexp(1.0, std::min(-std::ilogb(largest), 1023));
  }
  return scales;
}

/// By how much the coefficients of one degree, 1 or more, are other ones, of their own size; the
/// most of all degrees and functions that are not next to nothing.
double largest_change_of_a_degree(const Functions& wanted, const Functions& found) {
  constexpr double nothing = 1e-6;  // of all coefficients but the mean
  const Functions there = power_per_degree(wanted),
                  off = power_per_degree(found.topRows(wanted.rows()) - wanted);
  double largest = 0;
  for (Eigen::Index k = 0; k < there.cols(); ++k) {
    const double all = there.col(k).sum() - there(0, k);
    for (Eigen::Index l = 1; l < there.rows(); ++l)
      if (there(l, k) > nothing * nothing * all)
        largest = std::max(largest, std::sqrt(off(l, k) / there(l, k)));
  }
  return largest;
}

/// From the coefficients that are there.
void improve(const HarmonicLeastSquares& squares, Eigen::Index vertices, HarmonicFit& fit) {
  const Functions start = fit.coefficients;
  const auto [iterations, converged] = squares.solve(fit.coefficients);
  fit.iterations = iterations;
  fit.converged = converged;
  if (converged && start.rows() <= vertices) return;
  const HarmonicLeastSquares::Decided decided = squares.decided(start);
  fit.decided_degree = decided.degree;
  fit.decided_change = largest_change_of_a_degree(decided.coefficients, fit.coefficients);
}

}  // namespace

HarmonicFit fit_harmonics(const Topology& topology, const SphereMap& map, const Functions& values,
                          const HarmonicFitOptions& options) {
  require_harmonic_degree(options.degree);
  require_at_least("most_iterations", options.most_iterations, 0);
  require_between("tolerance", options.tolerance, 0, 1);
  if (values.rows() != topology.vertex_count() || map.points.rows() != topology.vertex_count()) {
    throw std::invalid_argument("spherical harmonics: not one value and one ray a vertex");
  }
  require_values(values);
  const VectorX scales = scales_of(values);
  const Functions scaled = values * scales.asDiagonal();
  const Carried carried(topology, map, values, scales, options);
  const VectorX shares = vertex_solid_angles(topology, map);
  HarmonicFit fit;
  if (options.least_squares) {
    fit.coefficients = integrate(carried, options.degree, options).coefficients;
    improve(HarmonicLeastSquares(map.points, shares, scaled, options), scaled.rows(), fit);
  } else {
    integrate_until_settled(carried, topology.face_count(), options, fit);
  }
  const Functions left = scaled - synthesise(fit.coefficients, map.points, options.threads);
  fit.rms = ((shares.asDiagonal() * left.cwiseAbs2()).colwise().sum() / shares.sum()).cwiseSqrt();
  fit.coefficients *= scales.cwiseInverse().asDiagonal();
  fit.rms = fit.rms.cwiseQuotient(scales);
  return fit;
}

}  // namespace sphparam
