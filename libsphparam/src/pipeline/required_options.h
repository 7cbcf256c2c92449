#pragma once

#include "sphparam/parameterize.h"

namespace sphparam {

/// Throws: std::invalid_argument if an option is outside of its domain, a pole, pin or meridian is
/// no vertex, the poles are one vertex, a vertex is pinned twice, or two are pinned at one point.
void require_domain(const TriangleMesh& mesh, const ParameterizeOptions& options);

}  // namespace sphparam
