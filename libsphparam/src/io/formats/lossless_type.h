#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/scalar_type.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// `declared` where it holds every number exactly, else Float64.
ScalarType lossless_type(ScalarType declared, const double* values, Eigen::Index count);

/// The same for formats without whole numbers of 64 bits: such are Int32 or Uint32 where these hold
/// all of them, else Float64.
ScalarType narrow_lossless_type(ScalarType declared, const double* values, Eigen::Index count);

/// The names of labels that are Float64 there.
std::vector<std::string> labels_beyond_32_bits(const std::vector<Property>& properties);

/// What is told of them, as a loss.
std::string words_of_lost_labels(const std::vector<std::string>& names);

}  // namespace sphparam
