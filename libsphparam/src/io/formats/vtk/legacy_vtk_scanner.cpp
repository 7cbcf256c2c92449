#include "io/formats/vtk/legacy_vtk_scanner.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "io/files/double_from_text.h"
#include "parsed_number.h"
#include "sphparam/io/read_options.h"

// Data begins after the line end that closes the words before it. Types are those of the machines
// that VTK runs on: long has 64 bits, vtkIdType is written as 32.

namespace sphparam {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
    if (low < 0) {
      result += text[i];
    } else {
      result += static_cast<char>(16 * high + low);
      i += 2;
    }
  }
  return result;
}

constexpr std::string_view bit_type = "BIT";

bool parse_type(std::string_view written, VtkType& type) {
  static constexpr std::pair<std::string_view, VtkType> types[] = {
      {"UNSIGNED_CHAR", VtkType::Uint8},
      {"CHAR", VtkType::Int8},
      {"SIGNED_CHAR", VtkType::Int8},
      {"UNSIGNED_SHORT", VtkType::Uint16},
      {"SHORT", VtkType::Int16},
      {"UNSIGNED_INT", VtkType::Uint32},
      {"INT", VtkType::Int32},
      {"UNSIGNED_LONG", VtkType::Uint64},
      {"LONG", VtkType::Int64},
      {"VTKTYPEINT64", VtkType::Int64},
      {"VTKTYPEUINT64", VtkType::Uint64},
      {"VTKIDTYPE", VtkType::Int32},
      {"FLOAT", VtkType::Float32},
      {"DOUBLE", VtkType::Float64},
      {bit_type, VtkType::Uint8}};
  const std::string name = upper(written);
  for (const auto& [known, value] : types) {
    if (name != known) continue;
    type = value;
    return true;
  }
  return false;
}

/// Whether a number of a text is one of this type; floats are still to be rounded.
bool fits(double value, VtkType type) {
  return with_vtk_type(type, [value](auto scalar) {
    using T = decltype(scalar);
    if constexpr (std::is_floating_point_v<T>) return true;
    return value == std::floor(value) &&
           value >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
           value <= static_cast<double>(std::numeric_limits<T>::max());
  });
}

}  // namespace

void LegacyVtkScanner::fail(const std::string& message) const {
  if (binary_) throw ReadError::at_byte(name_, at_, message);
  const std::string_view before = bytes_.substr(0, at_);
  throw ReadError::at_line(name_, 1 + std::count(before.begin(), before.end(), '\n'), message);
}

void LegacyVtkScanner::skip_blanks() {
  while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
}

std::string_view LegacyVtkScanner::line() {
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  std::string_view text = bytes_.substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view LegacyVtkScanner::word() {
  skip_blanks();
  std::size_t end = at_;
  while (end < bytes_.size() && !is_blank(bytes_[end])) ++end;
  const std::string_view found = bytes_.substr(at_, end - at_);
  at_ = end;
  return found;
}

std::string LegacyVtkScanner::next_keyword() {
  constexpr std::size_t longest_keyword = 64;
  const std::size_t before = at_;
  const std::string_view found = word();
  at_ = before;
  return upper(found.substr(0, longest_keyword));
}

std::string LegacyVtkScanner::name_word() { return decoded(word()); }

std::int64_t LegacyVtkScanner::count(const char* what) {
  const std::string_view text = word();
  const std::optional<std::int64_t> value = parsed<std::int64_t>(text);
  if (!value)
    fail("expected " + std::string(what) + ", found " +
         (text.empty() ? "the end of the file" : quoted(text)));
  if (*value < 0) fail("negative " + std::string(what));
  if (*value > std::numeric_limits<int>::max()) fail(std::string(what) + " is out of range");
  return *value;
}

/// Data begins in the next line.
void LegacyVtkScanner::end_line() {
  const std::string_view rest = line();
  if (!rest.empty()) fail("unexpected " + quoted(rest) + " at the end of the line");
}

std::vector<double> LegacyVtkScanner::numbers(std::string_view type, std::int64_t count,
                                              VtkType& kept, TextDigits digits) {
  if (!parse_type(type, kept)) fail("unknown type " + quoted(type));
  const auto size = static_cast<std::size_t>(count);
  if (!binary_) return text_numbers(kept, size, digits);
  end_line();
  return upper(type) == bit_type ? bits(size) : binary_numbers(kept, size);
}

std::vector<double> LegacyVtkScanner::binary_numbers(VtkType type, std::size_t count) {
  return with_vtk_type(type, [&](auto scalar) {
    if (count > (bytes_.size() - at_) / sizeof scalar)
      fail(std::to_string(count) + " numbers do not fit the " +
           std::to_string(bytes_.size() - at_) + " bytes that follow");
    std::vector<double> values(count);
    for (double& value : values) {
      char raw[sizeof scalar];
      std::memcpy(raw, bytes_.data() + at_, sizeof raw);
      if constexpr (std::endian::native == std::endian::little) std::reverse(raw, raw + sizeof raw);
      std::memcpy(&scalar, raw, sizeof raw);
      at_ += sizeof raw;
      value = static_cast<double>(scalar);
    }
    return values;
  });
}

/// Eight to a byte, the first one on top.
std::vector<double> LegacyVtkScanner::bits(std::size_t count) {
  constexpr std::size_t bits_per_byte = 8;
  const std::size_t size = (count + bits_per_byte - 1) / bits_per_byte;
  if (size > bytes_.size() - at_) fail("the file ends within an array of bits");
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto byte = static_cast<unsigned char>(bytes_[at_ + i / bits_per_byte]);
    values[i] = byte >> (bits_per_byte - 1 - i % bits_per_byte) & 1;
  }
  at_ += size;
  return values;
}

std::vector<double> LegacyVtkScanner::text_numbers(VtkType& type, std::size_t count,
                                                   TextDigits digits) {
  // A number takes two bytes with its separator, which the last one may lack.
  if (count > (bytes_.size() - at_ + 1) / 2)
    fail(std::to_string(count) + " numbers do not fit the " + std::to_string(bytes_.size() - at_) +
         " bytes that follow");
  Float32Texts floats(digits);
  std::vector<double> values(count);
  for (double& value : values) {
    std::string_view text = word();
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    const std::optional<double> found = parsed_double(text);
    if (!found || !fits(*found, type))
      fail("expected a number, found " + (text.empty() ? "the end of the file" : quoted(text)));
    value = *found;
    if (type == VtkType::Float32) floats.look_at(text, value);
  }
  floats.settle(type, values);
  return values;
}

bool LegacyVtkScanner::is_string_type(std::string_view type) { return upper(type) == "STRING"; }

std::vector<std::string> LegacyVtkScanner::strings(std::int64_t count) {
  end_line();
  if (static_cast<std::uint64_t>(count) > bytes_.size() - at_ + 1)
    fail(std::to_string(count) + " strings do not fit the " + std::to_string(bytes_.size() - at_) +
         " bytes that follow");
  std::vector<std::string> texts;
  for (std::int64_t i = 0; i < count; ++i)
    texts.push_back(binary_ ? binary_string() : decoded(line()));
  return texts;
}

// The top two bits of the first byte say how many bytes the length has: 3, 2, 1, 0 for 1, 2, 4, 8.
std::string LegacyVtkScanner::binary_string() {
  if (at_ == bytes_.size()) fail("the file ends within strings");
  const unsigned first = static_cast<unsigned char>(bytes_[at_]);
  const std::size_t width = std::size_t{1} << (3 - (first >> 6));
  if (width > bytes_.size() - at_) fail("the file ends within strings");
  std::uint64_t length = first & 63;
  for (std::size_t i = 1; i < width; ++i)
    length = length << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
  at_ += width;
  if (length > bytes_.size() - at_) fail("the file ends within strings");
  at_ += length;
  return std::string(bytes_.substr(at_ - length, length));
}

}  // namespace sphparam
