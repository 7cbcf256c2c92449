#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sphparam {

/// Scalar types of attributes: those of a PLY file, and whole numbers of 64 bits, which VTK has.
enum class ScalarType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Int64, Float32, Float64 };

/// Calls function(T{}) with a value of the C++ type behind `type`.
template <class Function>
decltype(auto) with_scalar(ScalarType type, Function&& function) {
  switch (type) {
    case ScalarType::Int8:
      return function(std::int8_t{});
    case ScalarType::Uint8:
      return function(std::uint8_t{});
    case ScalarType::Int16:
      return function(std::int16_t{});
    case ScalarType::Uint16:
      return function(std::uint16_t{});
    case ScalarType::Int32:
      return function(std::int32_t{});
    case ScalarType::Uint32:
      return function(std::uint32_t{});
    case ScalarType::Int64:
      return function(std::int64_t{});
    case ScalarType::Float32:
      return function(float{});
    case ScalarType::Float64:
      break;
  }
  return function(double{});
}

std::size_t size_in_bytes(ScalarType type);

bool is_floating(ScalarType type);

/// True when `value` survives a trip through `type` bit for bit.
bool holds_exactly(ScalarType type, double value);

/// The name PLY files use: char uchar short ushort int uint float double; of Int64, which they have
/// not, "int64".
std::string_view ply_name(ScalarType type);

/// The type behind a PLY name, of either family ("uchar" or "uint8"). Returns false for others.
bool parse_ply_name(std::string_view name, ScalarType& type);

}  // namespace sphparam
