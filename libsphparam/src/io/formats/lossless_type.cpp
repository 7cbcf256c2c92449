#include "io/formats/lossless_type.h"

#include <algorithm>

namespace sphparam {

ScalarType lossless_type(ScalarType declared, const double* values, Eigen::Index count) {
  if (declared == ScalarType::Float64) return declared;
  const bool exact = std::all_of(values, values + count,
                                 [=](double value) { return holds_exactly(declared, value); });
  return exact ? declared : ScalarType::Float64;
}

}  // namespace sphparam
