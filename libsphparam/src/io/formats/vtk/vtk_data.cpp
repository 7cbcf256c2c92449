// Data in front of which its size stands: text → (base64 →) (blocks of zlib →) bytes → numbers.
// Compressed: number of blocks, size of a block, size of the last one or 0, then the packed size
// of each. A size is believed only as far as the bytes that are there can bear it out.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "io/files/base64.h"
#include "io/files/double_from_text.h"
#include "io/files/gzip.h"
#include "io/formats/vtk/vtk_document.h"

namespace sphparam {
namespace {

constexpr std::uint64_t most_inflation = 1032, block_overhead = 64;  // of zlib
constexpr std::uint64_t most_numbers_per_byte = 64, always_allowed = 1 << 16;

bool parse_type(std::string_view written, VtkType& type) {
  static constexpr std::pair<std::string_view, VtkType> types[] = {
      {"Int8", VtkType::Int8},      {"UInt8", VtkType::Uint8},   {"Int16", VtkType::Int16},
      {"UInt16", VtkType::Uint16},  {"Int32", VtkType::Int32},   {"UInt32", VtkType::Uint32},
      {"Int64", VtkType::Int64},    {"UInt64", VtkType::Uint64}, {"Float32", VtkType::Float32},
      {"Float64", VtkType::Float64}};
  for (const auto& [known, value] : types) {
    if (written != known) continue;
    type = value;
    return true;
  }
  return false;
}

constexpr std::string_view bit_type = "Bit";
constexpr std::int64_t bits_per_byte = 8;

/// How many bytes these are in. Requires: count ≥ 0.
std::uint64_t bytes_of_bits(std::int64_t count) {
  return static_cast<std::uint64_t>((count + bits_per_byte - 1) / bits_per_byte);
}

/// Eight to a byte, the first one on top; those of a last byte that are no more of them are left.
std::vector<double> bits_of_bytes(const std::string& bytes, std::int64_t count) {
  const auto there = static_cast<std::int64_t>(bytes.size()) * bits_per_byte;
  const bool fits = count >= 0 && bytes.size() == bytes_of_bits(count);
  std::vector<double> values(static_cast<std::size_t>(fits ? count : there));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[i / bits_per_byte]);
    values[i] = byte >> (bits_per_byte - 1 - static_cast<int>(i % bits_per_byte)) & 1;
  }
  return values;
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The bytes of one array, one after another.
class Source {
 public:
  Source(const VtkDocument& document, const VtkXmlArray& array)
      : is_base64_(array.encoding == VtkEncoding::Binary || document.appended_is_base64),
        raw_(array.encoding == VtkEncoding::Binary
                 ? std::string_view(array.text)
                 : document.appended.substr(
                       std::min<std::uint64_t>(array.offset, document.appended.size()))),
        base64_(raw_) {}

  bool read(std::uint64_t count, std::string& bytes) {
    if (is_base64_) return base64_.read(count, bytes);
    if (count > raw_.size()) return false;
    bytes.append(raw_.substr(0, count));
    raw_.remove_prefix(count);
    return true;
  }

 private:
  bool is_base64_;
  std::string_view raw_;
  Base64Reader base64_;
};

class DataReader {
 public:
  DataReader(const VtkDocument& document, const VtkXmlArray& array, const std::string& name,
             std::uint64_t most_bytes)
      : document_(document),
        array_(array),
        name_(name),
        most_bytes_(most_bytes),
        source_(document, array) {}

  std::string bytes() {
    if (document_.compressed) return inflated();
    std::string bytes;
    const std::uint64_t size = header();
    require_within(size);
    read(size, bytes);
    return bytes;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    fail_in_array(name_, array_, message);
  }

  void require_within(std::uint64_t size) const {
    if (size > most_bytes_) fail("asks for more numbers than the file can hold");
  }

  void read(std::uint64_t count, std::string& bytes) {
    if (!source_.read(count, bytes)) fail("has data that is cut short or is no base64");
  }

  std::uint64_t header() {
    std::string bytes;
    read(document_.wide_headers ? sizeof(std::uint64_t) : sizeof(std::uint32_t), bytes);
    if (document_.order == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i-- > 0;)
      value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  }

  std::string inflated() {
    const std::uint64_t blocks = header();
    if (blocks == 0) return {};
    const std::uint64_t size = header(), last = header();
    std::vector<std::uint64_t> packed;  // grows as headers are there
    for (std::uint64_t i = 0; i < blocks; ++i) packed.push_back(header());
    std::string bytes;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      const bool is_last = i + 1 == blocks;
      unpack(packed[i], is_last && last > 0 ? last : size, bytes);
    }
    return bytes;
  }

  void unpack(std::uint64_t packed_size, std::uint64_t size, std::string& bytes) {
    std::string packed;
    read(packed_size, packed);
    if (size > most_inflation * packed_size + block_overhead)
      fail("has blocks that cannot unpack to the size they announce");
    require_within(size);
    require_within(bytes.size() + size);
    if (!unpack_block(packed, size, bytes)) fail("has compressed data that is corrupt");
  }

  const VtkDocument& document_;
  const VtkXmlArray& array_;
  const std::string& name_;
  std::uint64_t most_bytes_;
  Source source_;
};

std::vector<double> numbers_of_text(const VtkXmlArray& array, VtkType& type,
                                    const std::string& name, TextDigits digits) {
  Float32Texts floats(digits);
  std::vector<double> values;
  const char* at = array.text.data();
  const char* const end = at + array.text.size();
  for (;;) {
    at = std::find_if_not(at, end, is_blank);
    if (at == end) break;
    double value = 0;
    const char* const start = *at == '+' ? at + 1 : at;
    const auto [stop, error] = double_from_text(start, end, value);
    const bool whole = type != VtkType::Float32 && type != VtkType::Float64;
    if (error != std::errc{} || (stop != end && !is_blank(*stop)) ||
        (whole && value != std::floor(value)))
      fail_in_array(name, array,
                    "has " + quoted({at, std::find_if(at, end, is_blank)}) + " for a number");
    if (type == VtkType::Float32)
      floats.look_at({start, static_cast<std::size_t>(stop - start)}, value);
    values.push_back(value);
    at = stop;
  }
  floats.settle(type, values);
  return values;
}

std::vector<double> numbers_of_bytes(const std::string& bytes, VtkType type, std::endian order,
                                     const VtkXmlArray& array, const std::string& name) {
  return with_vtk_type(type, [&](auto scalar) {
    if (bytes.size() % sizeof scalar != 0) fail_in_array(name, array, "has half a number");
    std::vector<double> values(bytes.size() / sizeof scalar);
    for (std::size_t i = 0; i < values.size(); ++i) {
      char raw[sizeof scalar];
      std::memcpy(raw, bytes.data() + i * sizeof raw, sizeof raw);
      if (order != std::endian::native) std::reverse(raw, raw + sizeof raw);
      std::memcpy(&scalar, raw, sizeof raw);
      values[i] = static_cast<double>(scalar);
    }
    return values;
  });
}

}  // namespace

VtkDecoder::VtkDecoder(const VtkDocument& document, std::size_t file_bytes, const std::string& name)
    : document_(document),
      name_(name),
      numbers_left_(most_numbers_per_byte * file_bytes + always_allowed) {}

VtkArray VtkDecoder::numbers(const VtkXmlArray& array, std::int64_t count,
                             std::vector<std::string>& notes, TextDigits digits) {
  VtkType type = VtkType::Uint8;
  const bool is_bits = array.type == bit_type;
  if (!is_bits && !parse_type(array.type, type))
    fail_in_array(name_, array, "has the unknown type " + quoted(array.type));
  VtkArray decoded;
  decoded.name = array.name;
  decoded.width = array.width;
  decoded.component_names = array.component_names;
  if (count != 0 && array.encoding == VtkEncoding::Ascii) {
    decoded.values = numbers_of_text(array, type, name_, digits);
  } else if (count != 0) {
    DataReader reader(
        document_, array, name_,
        is_bits ? numbers_left_ / bits_per_byte : numbers_left_ * size_in_bytes(type));
    decoded.values = is_bits
                         ? bits_of_bytes(reader.bytes(), count)
                         : numbers_of_bytes(reader.bytes(), type, document_.order, array, name_);
    numbers_left_ -= decoded.values.size();
  }
  const auto found = static_cast<std::int64_t>(decoded.values.size());
  if (count >= 0 && found != count)
    fail_in_array(name_, array,
                  "has " + std::to_string(found) + " numbers, not " + std::to_string(count));
  decoded.type = kept_type(type, decoded, notes);
  return decoded;
}

std::vector<std::string> VtkDecoder::strings(const VtkXmlArray& array) {
  std::string bytes;
  if (array.encoding != VtkEncoding::Ascii) {
    bytes = DataReader(document_, array, name_, numbers_left_).bytes();
    numbers_left_ -= bytes.size();
  } else {
    constexpr double last_byte = 255;
    VtkType type = VtkType::Int32;
    for (const double code : numbers_of_text(array, type, name_, TextDigits::AsDeclared))
      bytes += static_cast<char>(static_cast<int>(std::clamp(code, 0.0, last_byte)));
  }
  std::vector<std::string> strings;
  for (std::size_t start = 0; start < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\0', start), bytes.size());
    strings.push_back(bytes.substr(start, end - start));
    start = end + 1;
  }
  return strings;
}

}  // namespace sphparam
