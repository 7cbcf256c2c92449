#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "option_domain.h"
#include "sphere/harmonic_degree.h"
#include "sphere/solid_angle.h"
#include "sphparam/sphere/sphere_locator.h"
#include "sphparam/sphere/spherical_harmonics.h"

// First the projection by quadrature of the piecewise linear functions that the map carries to the
// sphere; then, with W the vertices' shares of the sphere, conjugate gradients on
//   YᵀWY c = YᵀW f
// from there: YᵀWY is near the identity where triangles are small against a wave, and neither it
// nor Y is ever made. Where the integral is what is wanted, the nodes are as many as the triangles
// ask for, whatever the degree: few nodes take what changes between them for a long wave.

namespace sphparam {
namespace {

/// Values at directions of the piecewise linear functions that a map carries to the sphere.
Functions look_up(const Topology& topology, const SphereMap& map, const Functions& values,
                  const Points& directions, int threads) {
  const std::vector<SurfacePoint> points =
      SphereLocator(topology, map, threads).locate_all(directions, threads);
  Functions result(directions.rows(), values.cols());
  for (size_t i = 0; i < points.size(); ++i) {
    auto row = result.row(static_cast<Eigen::Index>(i));
    row.setZero();
    for (int k = 0; k < 3; ++k) {
      row += points[i].barycentric[k] * values.row(topology.vertex(points[i].face, k));
    }
  }
  return result;
}

struct Integral {
  Functions coefficients;
  VectorX spread;  // of each function: √∫(f − mean)²
};

/// By the nodes of a grid of at least the degree wanted.
Integral integrate(const Topology& topology, const SphereMap& map, const Functions& values,
                   int grid_degree, const HarmonicFitOptions& options) {
  report(options.progress, "quadrature", 0);
  const QuadratureGrid grid = quadrature_grid(grid_degree);
  const Functions f = look_up(topology, map, values, grid.directions, options.threads);
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
void integrate_until_settled(const Topology& topology, const SphereMap& map,
                             const Functions& values, const HarmonicFitOptions& options,
                             HarmonicFit& fit) {
  const double of_mesh = std::ceil(std::sqrt(0.5 * topology.face_count()));
  int degree =
      std::max(options.degree, static_cast<int>(std::min(of_mesh, 0.5 * greatest_harmonic_degree)));
  Integral found = integrate(topology, map, values, degree, options);
  while (degree < greatest_harmonic_degree) {
    degree = std::min(std::max(2 * degree, 1), greatest_harmonic_degree);
    Integral finer = integrate(topology, map, values, degree, options);
    fit.quadrature_change = largest_change(found, finer);
    found = std::move(finer);
    if (*fit.quadrature_change <= settled_quadrature) break;
  }
  fit.quadrature_degree = degree;
  fit.coefficients = std::move(found.coefficients);
}

/// Conjugate gradients on YᵀWY c = YᵀW f, all functions side by side, each with its own steps.
class NormalEquations {
 public:
  NormalEquations(const Points& directions, const VectorX& weights,
                  const HarmonicFitOptions& options)
      : directions_(directions), weights_(weights), options_(options) {}

  int solve(const Functions& values, Functions& coefficients) const {
    const Eigen::ArrayXd enough =
        options_.tolerance * options_.tolerance * transposed(values).colwise().squaredNorm();
    Functions residual = transposed(values - synthesised(coefficients));
    Functions direction = residual;
    Eigen::ArrayXd squared = residual.colwise().squaredNorm();
    int iteration = 0;
    while (iteration < options_.most_iterations && (squared > enough).any()) {
      report(options_.progress, "least squares",
             static_cast<double>(iteration) / options_.most_iterations);
      const Functions image = transposed(synthesised(direction));
      const Eigen::ArrayXd curvature = direction.cwiseProduct(image).colwise().sum();
      const Eigen::ArrayXd step =
          (squared > enough && curvature > 0).select(squared / curvature, 0.0);
      coefficients += direction * step.matrix().asDiagonal();
      residual -= image * step.matrix().asDiagonal();
      const Eigen::ArrayXd next = residual.colwise().squaredNorm();
      const Eigen::ArrayXd keep = (squared > enough).select(next / squared, 0.0);
      direction = residual + direction * keep.matrix().asDiagonal();
      squared = next;
      ++iteration;
    }
    return iteration;
  }

 private:
  Functions synthesised(const Functions& coefficients) const {
    return synthesise(coefficients, directions_, options_.threads);
  }
  Functions transposed(const Functions& values) const {
    return analyse(options_.degree, directions_, weights_, values, options_.threads);
  }

  const Points& directions_;
  const VectorX& weights_;
  const HarmonicFitOptions& options_;
};

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
  HarmonicFit fit;
  const VectorX shares = vertex_solid_angles(topology, map);
  if (options.least_squares) {
    fit.coefficients = integrate(topology, map, scaled, options.degree, options).coefficients;
    fit.iterations = NormalEquations(map.points, shares, options).solve(scaled, fit.coefficients);
  } else {
    integrate_until_settled(topology, map, scaled, options, fit);
  }
  const Functions left = scaled - synthesise(fit.coefficients, map.points, options.threads);
  fit.rms = ((shares.asDiagonal() * left.cwiseAbs2()).colwise().sum() / shares.sum()).cwiseSqrt();
  fit.coefficients *= scales.cwiseInverse().asDiagonal();
  fit.rms = fit.rms.cwiseQuotient(scales);
  return fit;
}

}  // namespace sphparam
