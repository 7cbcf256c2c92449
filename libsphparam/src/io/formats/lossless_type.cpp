#include "io/formats/lossless_type.h"

#include <algorithm>

namespace sphparam {
namespace {

bool hold_all(ScalarType type, const double* values, Eigen::Index count) {
  return std::all_of(values, values + count,
                     [type](double value) { return holds_exactly(type, value); });
}

}  // namespace

ScalarType lossless_type(ScalarType declared, const double* values, Eigen::Index count) {
  if (declared == ScalarType::Float64) return declared;
  return hold_all(declared, values, count) ? declared : ScalarType::Float64;
}

ScalarType narrow_lossless_type(ScalarType declared, const double* values, Eigen::Index count) {
  if (declared != ScalarType::Int64) return lossless_type(declared, values, count);
  for (const ScalarType narrow : {ScalarType::Int32, ScalarType::Uint32})
    if (hold_all(narrow, values, count)) return narrow;
  return ScalarType::Float64;
}

}  // namespace sphparam
