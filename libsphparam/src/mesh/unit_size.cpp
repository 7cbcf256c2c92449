#include "mesh/unit_size.h"

#include <cmath>
#include <cstdlib>

namespace sphparam {

std::optional<Rescaled> at_unit_size(const TriangleMesh& mesh) {
  constexpr int harmless = 100;  // binary orders of magnitude
  if (mesh.vertex_count() == 0) return std::nullopt;
  const int exponent = std::ilogb(mesh.positions.cwiseAbs().maxCoeff());
  if (exponent == FP_ILOGB0 || std::abs(exponent) <= harmless) return std::nullopt;
  Rescaled result{mesh, exponent};
  for (Eigen::Index i = 0; i < mesh.positions.size(); ++i) {
    double& x = result.mesh.positions.data()[i];
    x = std::ldexp(x, -exponent);
  }
  return result;
}

}  // namespace sphparam
