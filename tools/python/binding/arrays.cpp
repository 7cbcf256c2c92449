// One pass over the memory of an array as it lies: whatever its steps and the order of its bytes,
// each number is read, judged and stored once.

#include "arrays.h"

#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "sphparam/io/scalar_type.h"
#include "sphparam/parallel.h"
#include "texts.h"

namespace sphparam::python {
namespace {

constexpr std::int64_t rows_a_chunk = 1 << 15;

template <class Scalar>
Scalar with_bytes_turned(Scalar value) {
  unsigned char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  for (std::size_t i = 0; i < sizeof value / 2; ++i)
    std::swap(bytes[i], bytes[sizeof value - 1 - i]);
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// A number at any address.
template <class Scalar, bool Turned>
Scalar number_at(const char* place) {
  Scalar value;
  std::memcpy(&value, place, sizeof value);
  return Turned ? with_bytes_turned(value) : value;
}

/// Fills `table` with converted numbers; false where `convert` says so of one.
template <class Scalar, bool Turned, class Table, class Convert>
bool read_rows(const py::array& array, Table& table, const Convert& convert) {
  const auto* const data = static_cast<const char*>(array.data());
  const py::ssize_t down = array.strides(0), right = array.strides(1);
  std::atomic<bool> good = true;
  parallel_for(table.rows(), rows_a_chunk, 0, [&](std::int64_t first, std::int64_t last) {
    bool all = true;
    for (std::int64_t row = first; row < last; ++row) {
      for (int k = 0; k < 3; ++k)
        all &= convert(number_at<Scalar, Turned>(data + row * down + k * right), table(row, k));
    }
    if (!all) good = false;
  });
  return good;
}

template <class Scalar, class Table, class Convert>
bool read_typed(const py::array& array, Table& table, const Convert& convert) {
  const bool turned =
      array.dtype().byteorder() == (std::endian::native == std::endian::little ? '>' : '<');
  return turned ? read_rows<Scalar, true>(array, table, convert)
                : read_rows<Scalar, false>(array, table, convert);
}

/// Calls with the type of the array's numbers.
template <class Table, class Convert>
bool read_table(const py::array& array, Table& table, const Convert& convert) {
  const auto as = [&](auto type) { return read_typed<decltype(type)>(array, table, convert); };
  const std::string type = std::string(1, array.dtype().kind()) + std::to_string(array.itemsize());
  if (type == "f8") return as(double{});
  if (type == "f4") return as(float{});
  if (type == "i1") return as(std::int8_t{});
  if (type == "i2") return as(std::int16_t{});
  if (type == "i4") return as(std::int32_t{});
  if (type == "i8") return as(std::int64_t{});
  if (type == "u1") return as(std::uint8_t{});
  if (type == "u2") return as(std::uint16_t{});
  if (type == "u4") return as(std::uint32_t{});
  if (type == "u8") return as(std::uint64_t{});
  throw py::type_error("no array of numbers: " + type);
}

}  // namespace

Points points_of(const py::array& array, bool& finite) {
  Points points(array.shape(0), 3);
  finite = read_table(array, points, [](auto number, double& coordinate) {
    coordinate = static_cast<double>(number);
    return std::isfinite(coordinate);
  });
  return points;
}

Triangles triangles_of(const py::array& array, int count, bool& inside) {
  Triangles triangles(array.shape(0), 3);
  inside = read_table(array, triangles, [count](auto number, int& index) {
    using Number = decltype(number);
    if constexpr (std::is_floating_point_v<Number>) {
      return false;  // Python lets none through
    } else {
      const bool held = std::in_range<int>(number);
      index = held ? static_cast<int>(number) : -1;
      return held && index >= 0 && index < count;
    }
  });
  return triangles;
}

py::array values_of(const Property& property) {
  return with_scalar(property.type, [&](auto type) {
    using Scalar = decltype(type);
    std::vector<Scalar> values;
    values.reserve(property.values.size());
    for (const double value : property.values) values.push_back(static_cast<Scalar>(value));
    return owning(std::move(values));
  });
}

py::list columns_of(const std::vector<Property>& properties) {
  py::list list;
  for (const Property& property : properties)
    list.append(py::make_tuple(as_text(property.name), values_of(property)));
  return list;
}

}  // namespace sphparam::python
