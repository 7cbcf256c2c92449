#pragma once

#include <functional>

#include "embedding/multigrid/block_matrix.h"

namespace sphparam {

class Multigrid;

struct LinearSolution {
  Unknowns x;
  double gain = 0;  // b·x = xᵀ A x, twice what the step lowers the quadratic model by
  int iterations = 0;
  bool complete = false;  // ended by `least_share`
};

/// Preconditioned conjugate gradients for A x = b from x = 0, until an iteration has lowered
/// xᵀ A x / 2 − b·x by no more than `least_share` of what all of them have, that iteration counted
/// and kept. At most `most_iterations`; none more after a direction whose curvature dᵀ A d is not
/// positive (rounding, nothing left to solve, or A is not semidefinite), or before one that the
/// preconditioner turns uphill: x is then what it was before, downhill all the same. Uses b up.
/// Requires: A symmetric, least_share < 1.
/// `ask` is called in every iteration and may throw.
/// Ensures: same bits for any number of threads. Cost: linear an iteration.
LinearSolution solve_by_conjugate_gradients(const BlockMatrix<2>& matrix, Multigrid& multigrid,
                                            Unknowns b, double least_share, int most_iterations,
                                            int threads, const std::function<void()>& ask = {});

}  // namespace sphparam
