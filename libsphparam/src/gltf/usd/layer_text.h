#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/text_buffer.h"
#include "sphparam/gltf/asset.h"

namespace sphparam {

/// A layer of USD as text, four blanks a level, as USD's own tools print it.
class LayerText {
 public:
  using Words = std::initializer_list<std::string_view>;

  explicit LayerText(std::size_t expected_bytes) : text_(expected_bytes) {}

  /// A line; each % is the next of the words.
  void line(std::string_view pattern, Words words = {});

  /// A line that ends with a bracket, and what stands in it until that is closed.
  void open(std::string_view pattern, Words words = {});
  void close(std::string_view bracket = "}");

  /// "TYPE[] NAME = [(…), …]", a tuple a row, with as many digits as float32 needs to be read back.
  void rows(std::string_view type_and_name, const FloatRows& rows);
  /// The same of what vertices have, or "faceVarying": corners.
  void varying_rows(std::string_view type_and_name, std::string_view what, const FloatRows& rows);
  void vertex_rows(std::string_view type_and_name, const FloatRows& rows) {
    varying_rows(type_and_name, "vertex", rows);
  }
  void numbers(std::string_view type_and_name, const std::vector<std::uint32_t>& numbers);

  std::string take() { return text_.take(); }

 private:
  void indent();
  void put_rows(const FloatRows& rows);

  TextBuffer text_;
  int depth_ = 0;
};

/// A string as a layer has it, in quotes. Bytes that are not UTF-8 are replaced.
std::string usd_string(std::string_view text);

/// A name that a prim may have: what is no letter, digit or _ becomes one, and none begins with a
/// digit. Never empty.
std::string usd_name(std::string_view text);

}  // namespace sphparam
