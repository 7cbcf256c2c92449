#include "sphere/harmonic_least_squares.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sphparam {
namespace {

/// A step goes on between the vertices where its squares there, weighted, are less than this of its
/// integral of squares.
constexpr double share_at_vertices = 0.1;
/// Such a step is not worth taking for less than this of the squares left at the vertices:
/// functions that are harmonics at the vertices lose more by each, noise does not.
constexpr double worth_taking = 1e-3;

int degree_of(Eigen::Index harmonics) {
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(harmonics)))) - 1;
}

/// By how much the sums of a function with all harmonics are off by rounding, of its own size.
double rounding_of(Eigen::Index harmonics) {
  return 4 * std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(harmonics));
}

}  // namespace

Functions HarmonicLeastSquares::transposed(const Functions& values, Eigen::Index harmonics) const {
  return analyse(degree_of(harmonics), directions_, weights_, values, options_.threads);
}

Eigen::ArrayXd HarmonicLeastSquares::weighted_squares(const Functions& values) const {
  return (weights_.transpose() * values.cwiseAbs2()).transpose();
}

Eigen::ArrayXd HarmonicLeastSquares::enough(Eigen::Index harmonics) const {
  const double share = options_.tolerance, rounding = rounding_of(harmonics);
  const Eigen::ArrayXd wanted =
      share * share * transposed(values_, harmonics).colwise().squaredNorm();
  return wanted.max(rounding * rounding * weighted_squares(values_));
}

HarmonicLeastSquares::End HarmonicLeastSquares::solve(Functions& coefficients) const {
  return solve(coefficients, worth_taking);
}

HarmonicLeastSquares::End HarmonicLeastSquares::solve(Functions& coefficients, double worth) const {
  using Mask = Eigen::Array<bool, Eigen::Dynamic, 1>;
  const Eigen::Index harmonics = coefficients.rows();
  const Eigen::ArrayXd settled = enough(harmonics);
  Functions left = values_ - synthesise(coefficients, directions_, options_.threads);
  Functions gradient = transposed(left, harmonics), direction = gradient;
  Eigen::ArrayXd squared = gradient.colwise().squaredNorm();
  Mask goes_on = squared > settled;
  bool is_open = false;
  int iteration = 0;
  for (; iteration < options_.most_iterations && goes_on.any(); ++iteration) {
    report(options_.progress, "least squares",
           static_cast<double>(iteration) / options_.most_iterations);
    const Functions change = synthesise(direction, directions_, options_.threads);
    const Eigen::ArrayXd at_vertices = weighted_squares(change);
    const Eigen::ArrayXd step = (goes_on && at_vertices > 0).select(squared / at_vertices, 0.0);
    const Eigen::ArrayXd over_sphere = direction.colwise().squaredNorm();
    const Mask is_between = goes_on && at_vertices < share_at_vertices * over_sphere &&
                            step * squared < worth * weighted_squares(left);
    is_open |= is_between.any();
    goes_on = goes_on && !is_between;
    const VectorX taken = goes_on.select(step, 0.0).matrix();
    coefficients += direction * taken.asDiagonal();
    left -= change * taken.asDiagonal();
    gradient = transposed(left, harmonics);
    const Eigen::ArrayXd next = gradient.colwise().squaredNorm();
    const VectorX keep = goes_on.select(next / squared, 0.0).matrix();
    direction = gradient + direction * keep.asDiagonal();
    goes_on = goes_on && next > settled;
    squared = next;
  }
  return {iteration, !is_open && !goes_on.any()};
}

HarmonicLeastSquares::Decided HarmonicLeastSquares::decided(const Functions& start) const {
  const auto vertices = static_cast<double>(directions_.rows());
  Decided decided{0, start.topRows(1)};
  int open = std::min(degree_of(start.rows()), static_cast<int>(std::sqrt(vertices)));
  while (open - decided.degree > 1) {
    const int middle = (decided.degree + open) / 2;
    Functions coefficients = start.topRows(Eigen::Index(middle + 1) * (middle + 1));
    if (solve(coefficients, std::numeric_limits<double>::infinity()).converged)
      decided = {middle, std::move(coefficients)};
    else
      open = middle;
  }
  return decided;
}

}  // namespace sphparam
