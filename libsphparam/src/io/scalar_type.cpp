#include "sphparam/io/scalar_type.h"

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace sphparam {
namespace {

struct TypeNames {
  ScalarType type;
  std::string_view classic;  // of the first PLY files
  std::string_view sized;    // of later ones; Int64 is in none
};

constexpr std::array<TypeNames, 9> type_names = {{
    {ScalarType::Int8, "char", "int8"},
    {ScalarType::Uint8, "uchar", "uint8"},
    {ScalarType::Int16, "short", "int16"},
    {ScalarType::Uint16, "ushort", "uint16"},
    {ScalarType::Int32, "int", "int32"},
    {ScalarType::Uint32, "uint", "uint32"},
    {ScalarType::Int64, "int64", "int64"},
    {ScalarType::Float32, "float", "float32"},
    {ScalarType::Float64, "double", "float64"},
}};

}  // namespace

std::size_t size_in_bytes(ScalarType type) {
  return with_scalar(type, [](auto scalar) { return sizeof(scalar); });
}

bool is_floating(ScalarType type) {
  return type == ScalarType::Float32 || type == ScalarType::Float64;
}

bool holds_exactly(ScalarType type, double value) {
  return with_scalar(type, [value](auto scalar) {
    using T = decltype(scalar);
    // Range first: converting a number a type cannot hold is undefined behaviour.
    constexpr double lowest = static_cast<double>(std::numeric_limits<T>::lowest());
    constexpr double highest = static_cast<double>(std::numeric_limits<T>::max());
    if (!(value >= lowest && value <= highest)) return false;
    if (sizeof(T) == sizeof(std::int64_t) && std::is_integral_v<T> && value == highest)
      return false;  // which is one more than the type has
    if (std::is_integral_v<T> && value == 0 && std::signbit(value)) return false;
    return static_cast<double>(static_cast<T>(value)) == value;
  });
}

std::string_view ply_name(ScalarType type) {
  return type_names[static_cast<std::size_t>(type)].classic;
}

bool parse_ply_name(std::string_view name, ScalarType& type) {
  for (const TypeNames& names : type_names) {
    if (names.type == ScalarType::Int64 || (name != names.classic && name != names.sized)) continue;
    type = names.type;
    return true;
  }
  return false;
}

}  // namespace sphparam
