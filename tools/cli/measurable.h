#pragma once

#include <stdexcept>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tools {

/// A mesh that can be mapped but not measured: ends with `MeshUnusable`.
class UnmeasurableMesh : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws UnmeasurableMesh for a mesh that has a map but no distances: without area, or of a size
/// whose powers doubles cannot hold. (Maps do not depend on size; fits and distances do.)
void require_measurable(const TriangleMesh& mesh);

}  // namespace sphparam::tools
