#include "io/formats/ply/ply_header.h"

#include <algorithm>

#include "parsed_number.h"

namespace sphparam {
namespace {

constexpr std::uint64_t least_ascii_bytes = 2;  // a digit and a separator

/// Words of one line, read from the left.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view next() {
    trim();
    const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(word.size());
    return word;
  }

  bool at_end() {
    trim();
    return rest_.empty();
  }

  /// All that is left but the one blank after the last word.
  std::string_view rest() const { return rest_.empty() ? rest_ : rest_.substr(1); }

 private:
  static constexpr std::string_view blanks = " \t\r\v\f";
  void trim() { rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size())); }
  std::string_view rest_;
};

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name, const ReadOptions& options)
      : bytes_(bytes), name_(name), options_(options) {
    const std::size_t first_end = bytes.find_first_of("\r\n");
    if (first_end == std::string_view::npos) return;
    const bool cr = bytes[first_end] == '\r';
    line_end_ = !cr ? "\n" : bytes.substr(first_end, 2) == "\r\n" ? "\r\n" : "\r";
  }

  PlyHeader parse() {
    Words magic(next_line());
    if (magic.next() != "ply" || !magic.at_end()) fail("expected the magic word 'ply'");
    while (parse_statement(next_line())) {
    }
    if (!format_seen_) fail("the header has no format line");
    if (header_.encoding != PlyEncoding::Ascii && line_end_ == "\r")
      fail(
          "the header of a binary file ends its lines in CR alone, which leaves open where its "
          "data begin; write it with LF");
    header_.body_offset = offset_;
    header_.body_line = line_ + 1;
    check_proportions();
    return std::move(header_);
  }

 private:
  std::string_view next_line() {
    ++line_;
    const std::string_view rest = bytes_.substr(offset_);
    const std::size_t length = rest.find(line_end_);
    if (std::min(length, rest.size()) > static_cast<std::uint64_t>(options_.max_line_bytes))
      fail("line is longer than the limit of " + std::to_string(options_.max_line_bytes) +
           " bytes");
    if (length == std::string_view::npos && rest.substr(0, 10) != "end_header")
      fail("the file ends within the header");
    const std::string_view line = rest.substr(0, length);
    if (line.find('\0') != std::string_view::npos) fail("NUL byte in the header");
    offset_ += std::min(line.size() + line_end_.size(), rest.size());
    return line;
  }

  /// Returns false at the end of the header.
  bool parse_statement(std::string_view line) {
    Words words(line);
    const std::string_view keyword = words.next();
    if (keyword == "comment" || keyword == "obj_info") {
      header_.comments.emplace_back(words.rest());
      header_.infos += keyword == "obj_info";
      return true;
    }
    if (keyword == "end_header") return expect_end(words), false;
    if (keyword == "format")
      parse_format(words);
    else if (keyword == "element")
      parse_element(words);
    else if (keyword == "property")
      parse_property(words);
    else if (!keyword.empty())
      fail("unknown header statement " + quoted(keyword));
    expect_end(words);
    return true;
  }

  void parse_format(Words& words) {
    const std::string_view encoding = words.next();
    if (format_seen_) fail("second format line");
    if (encoding == "ascii")
      header_.encoding = PlyEncoding::Ascii;
    else if (encoding == "binary_little_endian")
      header_.encoding = PlyEncoding::BinaryLittleEndian;
    else if (encoding == "binary_big_endian")
      header_.encoding = PlyEncoding::BinaryBigEndian;
    else
      fail("unknown format " + quoted(encoding));
    const std::string_view version = words.next();
    if (version != "1.0") fail("unknown format version " + quoted(version));
    format_seen_ = true;
  }

  void parse_element(Words& words) {
    PlyElement element;
    element.name = words.next();
    element.line = line_;
    if (element.name.empty()) fail("element without a name");
    if (header_.find(element.name)) fail("second element " + quoted(element.name));
    if (static_cast<std::int64_t>(header_.elements.size()) >= options_.max_ply_elements)
      fail("more elements than the limit of " + std::to_string(options_.max_ply_elements));
    element.count = parse_count(words.next());
    header_.elements.push_back(std::move(element));
  }

  std::int64_t parse_count(std::string_view word) const {
    const std::int64_t count = parsed<std::int64_t>(word).value_or(-1);
    if (count < 0) fail("expected a count, found " + quoted(word));
    return count;
  }

  void parse_property(Words& words) {
    if (header_.elements.empty()) fail("property before the first element");
    PlyElement& element = header_.elements.back();
    PlyProperty property;
    std::string_view type = words.next();
    if (type == "list") {
      property.is_list = true;
      property.count_type = parse_type(words.next());
      if (is_floating(property.count_type)) fail("list count of a floating-point type");
      type = words.next();
    }
    property.type = parse_type(type);
    property.name = words.next();
    if (property.name.empty()) fail("property without a name");
    if (element.find(property.name)) fail("second property " + quoted(property.name));
    if (static_cast<std::int64_t>(element.properties.size()) >= options_.max_ply_properties)
      fail("more properties than the limit of " + std::to_string(options_.max_ply_properties));
    element.properties.push_back(std::move(property));
  }

  ScalarType parse_type(std::string_view word) const {
    ScalarType type{};
    if (!parse_ply_name(word, type)) fail("unknown type " + quoted(word));
    return type;
  }

  void expect_end(Words& words) const {
    if (!words.at_end()) fail("unexpected " + quoted(words.next()) + " at the end of the line");
  }

  void check_proportions() const {
    std::uint64_t available = bytes_.size() - offset_;
    // The last number of a text needs no separator.
    if (header_.encoding == PlyEncoding::Ascii) ++available;
    for (const PlyElement& element : header_.elements) {
      const auto count = static_cast<std::uint64_t>(element.count);
      const std::uint64_t least = element.least_bytes(header_.encoding);
      if (least == 0 && count > 0)
        fail_at(element.line, "element " + quoted(element.name) + " has no properties");
      if (least == 0) continue;
      if (count > available / least)
        fail_at(element.line, std::to_string(count) + " records of element " +
                                  quoted(element.name) + " do not fit the " +
                                  std::to_string(bytes_.size() - offset_) +
                                  " bytes after the header");
      available -= count * least;
    }
  }

  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(long line, const std::string& message) const {
    throw ReadError::at_line(name_, line, message);
  }

  std::string_view bytes_;
  const std::string& name_;
  const ReadOptions& options_;
  std::string_view line_end_ = "\n";
  std::size_t offset_ = 0;
  long line_ = 0;
  bool format_seen_ = false;
  PlyHeader header_;
};

}  // namespace

const PlyProperty* PlyElement::find(std::string_view property_name) const {
  for (const PlyProperty& property : properties)
    if (property.name == property_name) return &property;
  return nullptr;
}

std::uint64_t PlyElement::least_bytes(PlyEncoding encoding) const {
  constexpr std::uint64_t least_corners = 3;
  const bool ascii = encoding == PlyEncoding::Ascii;
  bool has_corners = name != "face";
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : properties) {
    const ScalarType first = property.is_list ? property.count_type : property.type;
    bytes += ascii ? least_ascii_bytes : size_in_bytes(first);
    if (has_corners || !property.is_list || !is_corner_list_name(property.name)) continue;
    bytes += least_corners * (ascii ? least_ascii_bytes : size_in_bytes(property.type));
    has_corners = true;
  }
  return bytes;
}

const PlyElement* PlyHeader::find(std::string_view element_name) const {
  for (const PlyElement& element : elements)
    if (element.name == element_name) return &element;
  return nullptr;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& name,
                           const ReadOptions& options) {
  return HeaderParser(bytes, name, options).parse();
}

}  // namespace sphparam
