#pragma once

#include "sphparam/io/scalar_type.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// `declared` where it holds every number exactly, else Float64.
ScalarType lossless_type(ScalarType declared, const double* values, Eigen::Index count);

/// The same for formats without whole numbers of 64 bits: such are Int32 or Uint32 where these hold
/// all of them, else Float64.
ScalarType narrow_lossless_type(ScalarType declared, const double* values, Eigen::Index count);

}  // namespace sphparam
