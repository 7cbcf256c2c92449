#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "sphparam/io/read_options.h"

namespace sphparam {

/// Reads numbers of binary data one after another, in either byte order. Every failure is a
/// ReadError with the byte it happened at.
class ByteReader {
 public:
  /// Requires: `bytes` and `name` outlive the reader.
  ByteReader(std::string_view bytes, const std::string& name, std::endian order)
      : bytes_(bytes), name_(&name), order_(order) {}

  std::size_t offset() const { return offset_; }
  std::size_t remaining() const { return bytes_.size() - offset_; }
  std::string_view rest() const { return bytes_.substr(offset_); }

  /// `what` is being read: "the file ends within WHAT".
  void require(std::uint64_t count, const char* what) const {
    if (count > remaining()) fail(std::string("the file ends within ") + what);
  }

  template <class Number>
  Number number(const char* what) {
    require(sizeof(Number), what);
    char raw[sizeof(Number)];
    std::memcpy(raw, bytes_.data() + offset_, sizeof raw);
    if (order_ != std::endian::native) std::reverse(raw, raw + sizeof raw);
    offset_ += sizeof raw;
    Number value;
    std::memcpy(&value, raw, sizeof raw);
    return value;
  }

  std::string_view take(std::uint64_t count, const char* what) {
    require(count, what);
    offset_ += count;
    return bytes_.substr(offset_ - count, count);
  }

  /// Up to a line end and past it; empty where there is no other.
  std::string_view line(const char* what) {
    const std::size_t end = rest().find('\n');
    if (end == std::string_view::npos) fail(std::string("the file ends within ") + what);
    const std::string_view text = take(end, what);
    ++offset_;
    return text;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError::at_byte(*name_, offset_, message);
  }

 private:
  std::string_view bytes_;
  const std::string* name_;
  std::endian order_;
  std::size_t offset_ = 0;
};

/// Appends a number as it stands in memory of that byte order.
template <class Number>
void append_number(std::string& bytes, Number value, std::endian order) {
  static_assert(std::is_arithmetic_v<Number>);
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (order != std::endian::native) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof raw);
}

}  // namespace sphparam
