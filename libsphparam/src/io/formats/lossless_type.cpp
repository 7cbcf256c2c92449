#include "io/formats/lossless_type.h"

#include <algorithm>

#include "sphparam/io/losses.h"

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

std::vector<std::string> labels_beyond_32_bits(const std::vector<Property>& properties) {
  std::vector<std::string> names;
  for (const Property& property : properties) {
    const auto count = static_cast<Eigen::Index>(property.values.size());
    if (property.type == ScalarType::Int64 &&
        is_floating(narrow_lossless_type(property.type, property.values.data(), count)))
      names.push_back(property.name);
  }
  return names;
}

std::string words_of_lost_labels(const std::vector<std::string>& names) {
  return enumerated(names) +
         " as labels: whole numbers beyond 32 bits are doubles there, which are averaged (.vtp and "
         ".vtk have room)";
}

}  // namespace sphparam
