#include "embedding/frame/mobius_recentring.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdint>

#include "sphparam/parallel.h"

// The Möbius transformations of the sphere are turns, which change no energy, after
// translations of the ball that take its centre to a, |a| < 1. Three numbers: the energy's
// derivatives in them are taken by differences, curvatures below zero are turned round, and the
// step is halved until it lowers the energy.

namespace sphparam {
namespace {

constexpr double difference = 0.01;       // of a, for derivatives
constexpr double longest_step = 0.3;      // |a|
constexpr double least_curvature = 1e-3;  // of the greatest
constexpr int halvings = 6;
constexpr std::int64_t vertex_grain = 512;

/// The Möbius transformation that takes the centre of the ball to a: x ↦ ((1 − |a|²) x + 2 (1 +
/// a·x) a) / |x + a|², |a| < 1
void move_centre(const std::vector<ImagePoint>& from, const Vector3& a, std::vector<ImagePoint>& to,
                 int threads) {
  to.resize(from.size());
  parallel_for(static_cast<std::int64_t>(from.size()), vertex_grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto v = static_cast<size_t>(first); v < static_cast<size_t>(last); ++v) {
                   const Vector3 x = from[v].vector();
                   const Vector3 y = (1 - a.squaredNorm()) * x + 2 * (1 + a.dot(x)) * a;
                   to[v] = image_point(y.normalized());
                 }
               });
}

struct Derivatives {
  Vector3 gradient;
  Eigen::Matrix3d hessian;
};

/// Differences of E along the axes and their sums.
template <class EnergyAt>
Derivatives differentiate(double before, const EnergyAt& energy_at) {
  const double h = difference;
  Vector3 gradient, ahead;
  Eigen::Matrix3d hessian;
  for (int i = 0; i < 3; ++i) {
    ahead[i] = energy_at(h * Vector3::Unit(i));
    const double behind = energy_at(-h * Vector3::Unit(i));
    gradient[i] = (ahead[i] - behind) / (2 * h);
    hessian(i, i) = (ahead[i] - 2 * before + behind) / (h * h);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      const double both = energy_at(h * (Vector3::Unit(i) + Vector3::Unit(j)));
      hessian(i, j) = hessian(j, i) = (both - ahead[i] - ahead[j] + before) / (h * h);
    }
  }
  return {gradient, hessian};
}

}  // namespace

double recentre(std::vector<ImagePoint>& image, double before,
                const std::function<double(const std::vector<ImagePoint>&)>& energy_of,
                int threads) {
  std::vector<ImagePoint> candidate;
  const auto energy_at = [&](const Vector3& a) {
    move_centre(image, a, candidate, threads);
    return energy_of(candidate);
  };
  const auto [gradient, hessian] = differentiate(before, energy_at);
  if (!hessian.allFinite() || !gradient.allFinite()) return before;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(hessian);
  const Vector3 curvature = eigen.eigenvalues().cwiseAbs();
  const double floor = least_curvature * curvature.maxCoeff();
  if (!(floor > 0)) return before;
  Vector3 a =
      -(eigen.eigenvectors() *
        (eigen.eigenvectors().transpose() * gradient).cwiseQuotient(curvature.cwiseMax(floor)));
  a *= std::min(1.0, longest_step / a.norm());
  for (int i = 0; i < halvings; ++i, a /= 2) {
    const double after = energy_at(a);
    if (!(after < before)) continue;
    image.swap(candidate);
    return after;
  }
  return before;
}

}  // namespace sphparam
