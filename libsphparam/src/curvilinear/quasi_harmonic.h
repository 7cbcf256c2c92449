#pragma once

#include <vector>

#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// κ_T = (Σ A / Σ A') · A'_T / A_T, the spherical distortion of area, for every triangle T of the
/// mesh: A' is the area of the spherical triangle, A that of the rest triangle.
/// Paper: Section 4. Both areas are floored, at 1e-9 and 1e-18 of their means, so that κ is
/// positive and finite; a folded triangle counts with the size of its area.
/// The next map of the paper solves div(κ grad U) = 0: the weights are multiplied by κ.
std::vector<double> area_distortion(const TriangleMesh& mesh, const SphereMap& map,
                                    int threads = 0);

/// κ_acc ← κ_acc·κ^power; an empty κ_acc is 1 everywhere.
/// Our own: the paper's iteration, with κ of the last map alone, swings from one side of the
/// solution to the other and diverges after two or three steps (its derivative in log κ is near −1
/// there); accumulating κ does not forget what was reached, and with √κ each step goes half way.
void accumulate_kappa(std::vector<double>& accumulated, const std::vector<double>& kappa,
                      double power, int threads = 0);

/// The mean of |ln κ_T| over all triangles: the paper's area distortion (Section 6) as one figure.
double mean_abs_ln(const std::vector<double>& kappa, int threads = 0);

}  // namespace sphparam
