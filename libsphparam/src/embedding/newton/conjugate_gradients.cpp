#include "embedding/newton/conjugate_gradients.h"

#include <cstdint>

#include "embedding/multigrid/multigrid.h"
#include "sphparam/parallel.h"

// The method of Hestenes and Stiefel, a V-cycle before every direction.

namespace sphparam {
namespace {

double dot(const Unknowns& a, const Unknowns& b, int threads) {
  return parallel_sum(
      static_cast<std::int64_t>(a.size()), threads, [&](std::int64_t first, std::int64_t last) {
        double sum = 0;
        for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i) {
          sum += a[i] * b[i];
        }
        return sum;
      });
}

/// a += factor · b
void add(Unknowns& a, double factor, const Unknowns& b) {
  for (size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

}  // namespace

LinearSolution solve_by_conjugate_gradients(const BlockMatrix<2>& matrix, Multigrid& multigrid,
                                            Unknowns r, double least_share, int most_iterations,
                                            int threads, const std::function<void()>& ask) {
  const size_t n = r.size();
  LinearSolution solution{Unknowns(n, 0.0)};
  Unknowns z(n), direction(n, 0.0), image(n);
  double rz = 0;
  while (solution.iterations < most_iterations) {
    if (ask) ask();
    // 1. The next direction: the preconditioned residual, made conjugate to the one before.
    multigrid.apply(r, z, image);
    const double next = dot(r, z, threads);
    if (!(next > 0)) break;
    const double share = rz > 0 ? next / rz : 0.0;
    for (size_t i = 0; i < n; ++i) direction[i] = z[i] + share * direction[i];
    rz = next;
    // 2. The step along it that minimises the quadratic form.
    multiply(matrix, direction.data(), image.data(), threads);
    const double curvature = dot(direction, image, threads);
    if (!(curvature > 0)) break;
    add(solution.x, rz / curvature, direction);
    // 3. What it has gained, and whether another is worth it.
    const double gain = rz * rz / curvature;  // b·d = r·z: directions are conjugate
    solution.gain += gain;
    ++solution.iterations;
    // Of what is left nothing is known but this: asking the preconditioner costs an iteration.
    solution.complete = !(gain > least_share * solution.gain);
    if (solution.complete) break;
    add(r, -rz / curvature, image);
  }
  return solution;
}

}  // namespace sphparam
