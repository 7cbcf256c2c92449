#include "io/formats/gifti/gifti_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/files/double_from_text.h"

// text → (base64 → (inflate →)) bytes → numbers. The size is known before each step, and a step
// that ends with more or less is an error: nothing is guessed, cut or padded with zeros.

namespace sphparam {
namespace {

constexpr const char* ascii = "ASCII";
constexpr const char* base64 = "Base64Binary";
constexpr const char* compressed = "GZipBase64Binary";
constexpr std::int64_t most_numbers = std::numeric_limits<int>::max();

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Characters of the data that are no blanks: only they can hold anything.
std::size_t filled_characters(const GiftiArray& array) {
  return static_cast<std::size_t>(
      std::count_if(array.data.begin(), array.data.end(), [](char c) { return !is_blank(c); }));
}

/// The bytes behind base64 text, blanks between.
std::vector<unsigned char> from_base64(const GiftiArray& array, const std::string& name) {
  static const std::array<int, 256> digit_table = [] {
    std::array<int, 256> digits;
    digits.fill(-1);
    const std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i)
      digits[static_cast<unsigned char>(alphabet[i])] = static_cast<int>(i);
    return digits;
  }();
  std::vector<unsigned char> bytes;
  bytes.reserve(filled_characters(array) / 4 * 3);
  std::uint32_t group = 0;
  int digits = 0, padding = 0;
  for (const char c : array.data) {
    if (is_blank(c)) continue;
    const int digit = digit_table[static_cast<unsigned char>(c)];
    padding += c == '=';
    if ((digit < 0 && c != '=') || (padding > 0 && c != '='))
      fail_in_array(name, array, "has data that is no base64");
    group = group << 6 | static_cast<std::uint32_t>(std::max(digit, 0));
    if (++digits % 4 != 0) continue;
    if (padding > 2) break;
    for (int i = 0; i < 3 - padding; ++i)
      bytes.push_back(static_cast<unsigned char>(group >> (16 - 8 * i)));
    group = 0;
  }
  if (digits % 4 != 0 || padding > 2)
    fail_in_array(name, array, "has base64 data that is cut short");
  return bytes;
}

/// Ends an inflation on every way out.
struct Inflation {
  z_stream stream{};
  ~Inflation() { inflateEnd(&stream); }
};

std::vector<unsigned char> inflated(std::vector<unsigned char> packed, std::size_t size,
                                    const GiftiArray& array, const std::string& name) {
  constexpr int zlib_or_gzip = 15 + 32;
  Inflation inflation;
  if (inflateInit2(&inflation.stream, zlib_or_gzip) != Z_OK) throw std::bad_alloc();
  // One byte more than wanted shows that there is more. Room comes as bytes do: what a file says of
  // its size is not believed.
  const std::size_t most = size + 1;
  std::vector<unsigned char> bytes;
  z_stream& stream = inflation.stream;
  std::size_t filled = 0, used = 0;
  int status = Z_OK;
  while (status == Z_OK && filled < most) {
    constexpr std::size_t most_at_once = 1u << 30, first_room = 1u << 16;
    if (filled == bytes.size()) bytes.resize(std::min(most, std::max(first_room, 2 * filled)));
    stream.next_in = packed.data() + used;
    stream.avail_in = static_cast<uInt>(std::min(most_at_once, packed.size() - used));
    stream.next_out = bytes.data() + filled;
    stream.avail_out = static_cast<uInt>(std::min(most_at_once, bytes.size() - filled));
    const uInt room = stream.avail_out, given = stream.avail_in;
    status = inflate(&stream, Z_NO_FLUSH);
    filled += room - stream.avail_out;
    used += given - stream.avail_in;
  }
  if (status != Z_STREAM_END && filled <= size)
    fail_in_array(name, array, "has compressed data that is corrupt or cut short");
  if (filled != size) fail_in_array(name, array, "unpacks to another size than its dimensions say");
  bytes.resize(size);
  return bytes;
}

std::vector<double> from_bytes(std::vector<unsigned char>& bytes, const GiftiArray& array,
                               ScalarType type, const std::string& name) {
  const bool big = array.endian == "BigEndian";
  if (!big && array.endian != "LittleEndian")
    fail_in_array(name, array, "has the unknown byte order " + quoted(array.endian));
  const bool swap = big == (std::endian::native == std::endian::little);
  return with_scalar(type, [&](auto scalar) {
    std::vector<double> numbers(bytes.size() / sizeof scalar);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      unsigned char* const at = bytes.data() + i * sizeof scalar;
      if (swap) std::reverse(at, at + sizeof scalar);
      std::memcpy(&scalar, at, sizeof scalar);
      numbers[i] = static_cast<double>(scalar);
    }
    return numbers;
  });
}

/// False when the type does not have the number; reals are rounded to it.
bool fit(double& value, ScalarType type) {
  return with_scalar(type, [&value](auto scalar) {
    using T = decltype(scalar);
    if constexpr (std::is_same_v<T, double>) return true;
    if constexpr (std::is_same_v<T, float>) {
      const volatile float rounded = static_cast<float>(value);
      value = rounded;
      return true;
    }
    return value == std::floor(value) &&
           value >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
           value <= static_cast<double>(std::numeric_limits<T>::max());
  });
}

std::vector<double> from_text(std::size_t count, const GiftiArray& array, ScalarType type,
                              const std::string& name) {
  std::vector<double> numbers;
  numbers.reserve(count);
  const char* at = array.data.data();
  const char* const end = at + array.data.size();
  const auto fail = [&](const std::string& message) {
    throw ReadError::at_line(name, array.data_line + std::count(array.data.data(), at, '\n'),
                             message);
  };
  for (;;) {
    at = std::find_if_not(at, end, is_blank);
    if (at == end) break;
    if (numbers.size() == count) fail("more numbers than the dimensions say");
    double value = 0;
    const auto [stop, error] = double_from_text(at, end, value);
    const bool whole_token = stop == end || is_blank(*stop);
    if (error != std::errc{} || !whole_token || !fit(value, type))
      fail("expected a number, found " + quoted({at, std::find_if(at, end, is_blank)}));
    numbers.push_back(value);
    at = stop;
  }
  if (numbers.size() < count) fail("fewer numbers than the dimensions say");
  return numbers;
}

/// From column-major order to row-major order.
std::vector<double> transposed(const std::vector<double>& numbers, std::size_t rows) {
  const std::size_t columns = rows == 0 ? 0 : numbers.size() / rows;
  std::vector<double> result(numbers.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < columns; ++k) result[i * columns + k] = numbers[k * rows + i];
  return result;
}

}  // namespace

ScalarType gifti_type(const GiftiArray& array, const std::string& name) {
  static constexpr std::pair<std::string_view, ScalarType> types[] = {
      {"NIFTI_TYPE_UINT8", ScalarType::Uint8},     {"NIFTI_TYPE_INT32", ScalarType::Int32},
      {"NIFTI_TYPE_FLOAT32", ScalarType::Float32}, {"NIFTI_TYPE_FLOAT64", ScalarType::Float64},
      {"NIFTI_TYPE_INT8", ScalarType::Int8},       {"NIFTI_TYPE_INT16", ScalarType::Int16},
      {"NIFTI_TYPE_UINT16", ScalarType::Uint16},   {"NIFTI_TYPE_UINT32", ScalarType::Uint32}};
  for (const auto& [written, type] : types)
    if (array.data_type == written) return type;
  fail_in_array(name, array, "has the unsupported type " + quoted(array.data_type));
}

std::int64_t gifti_count(const GiftiArray& array, std::int64_t most_inflation,
                         const std::string& name) {
  if (array.encoding == "ExternalFileBinary" || !array.external_file.empty())
    fail_in_array(name, array, "has its data in another file, which is not supported");
  const auto size = static_cast<std::int64_t>(size_in_bytes(gifti_type(array, name)));
  const auto text = static_cast<std::int64_t>(filled_characters(array));
  std::int64_t most = 0;
  if (array.encoding == ascii)
    most = std::min(text, static_cast<std::int64_t>(array.data.size() + 1) / 2);
  else if (array.encoding == base64)
    most = text / 4 * 3 / size;
  else if (array.encoding == compressed)
    most = text / 4 * 3 * most_inflation / size;
  else
    fail_in_array(name, array, "has the unknown encoding " + quoted(array.encoding));

  std::int64_t count = 1;
  for (const std::int64_t dimension : array.dimensions) {
    count *= dimension;
    if (count > most_numbers) break;
  }
  if (count > std::min(most, most_numbers))
    fail_in_array(name, array, "has dimensions that its data cannot hold");
  return count;
}

std::vector<double> decode_gifti(const GiftiArray& array, const std::string& name) {
  const ScalarType type = gifti_type(array, name);
  std::size_t count = 1;
  for (const std::int64_t dimension : array.dimensions)
    count *= static_cast<std::size_t>(dimension);
  const std::size_t size = count * size_in_bytes(type);
  if (count == 0 && array.data.empty()) return {};  // not even an empty stream

  std::vector<double> numbers;
  if (array.encoding == ascii) {
    numbers = from_text(count, array, type, name);
  } else {
    std::vector<unsigned char> bytes = from_base64(array, name);
    if (array.encoding == compressed) bytes = inflated(std::move(bytes), size, array, name);
    if (bytes.size() != size)
      fail_in_array(name, array, "has another number of bytes than its dimensions say");
    numbers = from_bytes(bytes, array, type, name);
  }
  const bool by_column = array.order == "ColumnMajorOrder";
  if (!by_column && array.order != "RowMajorOrder")
    fail_in_array(name, array, "has the unknown order " + quoted(array.order));
  if (by_column) return transposed(numbers, static_cast<std::size_t>(array.dimensions[0]));
  return numbers;
}

}  // namespace sphparam
