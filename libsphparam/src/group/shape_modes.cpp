#include "sphparam/group/shape_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "group/shape_weights.h"
#include "sphparam/parallel.h"

// With Xᵢ = xᵢ − mean, G = ⟨Xᵢ, Xⱼ⟩ / (n − 1) = U Λ Uᵀ has the variances of the modes; mode k is
// Σ U_ik Xᵢ / √(n − 1), and the scores are U √(n − 1).

namespace sphparam {
namespace {

constexpr double least_deviation = 1e-10;  // of the shapes' size: below it there is none
constexpr double rounding = 1e-13;         // of the greatest variance: what the Gram matrix lost

size_t at(Eigen::Index i) { return static_cast<size_t>(i); }

double product(const Points& a, const Points& b, const VectorX& weights) {
  return a.cwiseProduct(b).rowwise().sum().dot(weights);
}

std::vector<Points> differences(const std::vector<Points>& shapes, const Points& mean,
                                const VectorX& weights) {
  if (shapes.empty()) throw std::invalid_argument("shape modes: there is no shape");
  std::vector<Points> result;
  for (const Points& shape : shapes) {
    if (shape.rows() != mean.rows() || shape.rows() != weights.size())
      throw std::invalid_argument("shape modes: not as many points in all shapes as weights");
    result.push_back(shape - mean);
  }
  require_weights(weights);
  return result;
}

Eigen::MatrixXd gram_matrix(const std::vector<Points>& x, const VectorX& weights, int threads) {
  const Eigen::Index count = std::ssize(x);
  Eigen::MatrixXd gram(count, count);
  parallel_for(count, 1, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      for (std::int64_t j = 0; j <= i; ++j)
        gram(i, j) = product(x[at(i)], x[at(j)], weights) / static_cast<double>(count - 1);
  });
  return gram.selfadjointView<Eigen::Lower>();
}

/// So that the entry of greatest size is positive, the first of several.
void fix_sign(VectorX& scores) {
  Eigen::Index greatest = 0;
  scores.cwiseAbs().maxCoeff(&greatest);
  if (scores[greatest] < 0) scores *= -1;
}

/// How many eigenvalues, ascending, are of modes.
Eigen::Index modes_among(const VectorX& ascending, double size, int most) {
  const double least =
      std::max(least_deviation * least_deviation * size * size, rounding * ascending.maxCoeff());
  const auto is_mode = [&](double variance) { return variance > least; };
  return std::min<Eigen::Index>(most, std::ranges::count_if(ascending, is_mode));
}

}  // namespace

ShapeModes shape_modes(const std::vector<Points>& shapes, const Points& mean,
                       const VectorX& weights, int most, int threads) {
  if (most < 0) throw std::invalid_argument("shape modes: a negative number of modes");
  const std::vector<Points> x = differences(shapes, mean, weights);
  const Eigen::Index count = std::ssize(shapes);
  ShapeModes result;
  result.scores = MatrixX(count, 0);
  if (count < 2) return result;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram_matrix(x, weights, threads));
  const VectorX values = solver.eigenvalues();
  const Vector3 centre = mean.transpose() * weights;
  const Points about = mean.rowwise() - centre.transpose();
  const Eigen::Index kept = modes_among(values, std::sqrt(product(about, about, weights)), most);
  result.variance = values.cwiseMax(0).sum();
  result.deviations = result.shares = VectorX(kept);
  result.scores = MatrixX(count, kept);
  for (Eigen::Index k = 0; k < kept; ++k) {
    const Eigen::Index column = count - 1 - k;
    VectorX scores = solver.eigenvectors().col(column) * std::sqrt(double(count - 1));
    fix_sign(scores);
    Points mode = Points::Zero(mean.rows(), 3);
    for (Eigen::Index i = 0; i < count; ++i) mode += scores[i] / double(count - 1) * x[at(i)];
    result.modes.push_back(std::move(mode));
    result.scores.col(k) = scores;
    result.deviations[k] = std::sqrt(values[column]);
    result.shares[k] = values[column] / result.variance;
  }
  return result;
}

Points along_mode(const Points& mean, const ShapeModes& modes, int mode, double deviations) {
  return mean + deviations * modes.modes.at(at(mode));
}

}  // namespace sphparam
