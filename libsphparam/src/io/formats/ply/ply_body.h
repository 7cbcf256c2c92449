#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "io/files/non_finite_advice.h"
#include "io/files/text_scanner.h"
#include "io/formats/ply/ply_header.h"

// A body gives the numbers of a PLY file one by one, in the order of its header, from a text or
// from bytes in either order. All bodies have the same functions, so that one reader serves every
// encoding:
//   begin(record), end()  about each record, of an element of the header
//   coordinate(type)      of a place: finite, unless the options allow others; with all its digits
//   exceeds_float32()     whether one that should be a Float32 had more digits than that holds
//   real(type)            finite
//   any_real(type)        any number
//   integer(type)         a whole number that the type holds
//   skip(type, count)     numbers that nobody wants
//   fail(message)         throws ReadError that says where in the file the body is

namespace sphparam {

/// The record that is read, for messages.
struct PlyRecord {
  const PlyElement* element = nullptr;
  std::int64_t index = 0;

  std::string describe() const {
    return element->name + " " + std::to_string(index) + " of " + std::to_string(element->count) +
           " (counted from 0)";
  }
};

/// The numbers of a text, one record a line.
class PlyTextBody {
 public:
  PlyTextBody(std::string_view bytes, const PlyHeader& header, const std::string& name,
              const ReadOptions& options)
      : scanner_(bytes.substr(header.body_offset), name, options, header.body_line) {
    scanner_.require_text();
  }

  void begin(const PlyRecord& record) {
    if (!scanner_.next_filled_line()) scanner_.fail("the file ends before " + record.describe());
  }

  void end() {
    if (!scanner_.at_line_end())
      scanner_.fail("unexpected " + sphparam::quoted(scanner_.peek_word()) +
                    " at the end of the line");
  }

  double coordinate(ScalarType type) {
    if (type == ScalarType::Float64) return scanner_.coordinate();
    if (type == ScalarType::Float32) return scanner_.coordinate32(exceeds_float32_);
    return real(type);
  }

  double real(ScalarType type) {
    if (type == ScalarType::Float64) return scanner_.real();
    if (type == ScalarType::Float32) return static_cast<double>(scanner_.real32());
    return static_cast<double>(integer(type));
  }

  double any_real(ScalarType type) {
    if (type == ScalarType::Float64) return scanner_.any_real();
    if (type == ScalarType::Float32) return static_cast<double>(scanner_.any_real32());
    return static_cast<double>(integer(type));
  }

  std::int64_t integer(ScalarType type) {
    const std::int64_t value = scanner_.integer();
    if (!holds_exactly(type, static_cast<double>(value)))
      fail(std::to_string(value) + " is no number of type " + std::string(ply_name(type)));
    return value;
  }

  // One byte a number at least is still to come: the length needs no check of its own.
  void skip(ScalarType type, std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) any_real(type);
  }

  bool exceeds_float32() const { return exceeds_float32_; }
  bool has_trailing_data() { return scanner_.next_filled_line(); }
  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

 private:
  TextScanner scanner_;
  bool exceeds_float32_ = false;
};

/// The numbers of bytes, record after record without a gap.
template <std::endian Order>
class PlyBinaryBody {
 public:
  PlyBinaryBody(std::string_view bytes, const PlyHeader& header, const std::string& name,
                const ReadOptions& options)
      : bytes_(bytes), name_(name), options_(options), offset_(header.body_offset) {}

  void begin(const PlyRecord& record) { record_ = record; }
  void end() {}

  double coordinate(ScalarType type) {
    return with_scalar(type, [this](auto scalar) {
      const double value = static_cast<double>(this->template read<decltype(scalar)>());
      if (!std::isfinite(value) && !options_.non_finite) fail_not_finite(non_finite_advice());
      return value;
    });
  }

  double real(ScalarType type) {
    return with_scalar(type, [this](auto scalar) {
      const double value = static_cast<double>(this->template read<decltype(scalar)>());
      if (!std::isfinite(value)) fail_not_finite();
      return value;
    });
  }

  double any_real(ScalarType type) {
    return with_scalar(type, [this](auto scalar) {
      return static_cast<double>(this->template read<decltype(scalar)>());
    });
  }

  std::int64_t integer(ScalarType type) {
    return with_scalar(type, [this](auto scalar) {
      return static_cast<std::int64_t>(this->template read<decltype(scalar)>());
    });
  }

  void skip(ScalarType type, std::int64_t count) {
    const std::size_t size = size_in_bytes(type);
    require(static_cast<std::uint64_t>(count) <= (bytes_.size() - offset_) / size);
    offset_ += static_cast<std::size_t>(count) * size;
  }

  bool exceeds_float32() const { return false; }
  bool has_trailing_data() const { return offset_ < bytes_.size(); }
  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError::at_byte(name_, offset_, message);
  }

 private:
  [[noreturn]] void fail_not_finite(const std::string& advice = "") const {
    fail("number is not finite in " + record_.describe() + advice);
  }

  void require(bool bytes_are_there) const {
    if (!bytes_are_there) [[unlikely]]
      fail("the file ends within " + record_.describe());
  }

  template <class T>
  T read() {
    require(sizeof(T) <= bytes_.size() - offset_);
    char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + offset_, sizeof(T));
    if constexpr (Order != std::endian::native) std::reverse(raw, raw + sizeof(T));
    offset_ += sizeof(T);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  std::string_view bytes_;
  const std::string& name_;
  const ReadOptions& options_;
  std::size_t offset_;
  PlyRecord record_;
};

}  // namespace sphparam
