#pragma once

#include "embedding/block_matrix.h"

namespace sphparam {

class Multigrid;

struct LinearSolution {
  Unknowns x;
  double gain = 0;  // b·x = xᵀ A x, twice what the step lowers the quadratic model by
  int iterations = 0;
};

/// Preconditioned conjugate gradients for A x = b, until an iteration (from the second on) has
/// lowered xᵀ A x / 2 − b·x by no more than `least_share` of what all of them have. Uses b up. Same
/// bits for any number of threads.
LinearSolution solve_by_conjugate_gradients(const BlockMatrix<2>& matrix, Multigrid& multigrid,
                                            Unknowns b, double least_share, int most_iterations,
                                            int threads);

}  // namespace sphparam
