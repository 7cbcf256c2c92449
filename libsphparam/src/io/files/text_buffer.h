#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

// What the writers of text formats share.

/// A text that grows by words and by numbers, these in the shortest form that reads back the same.
class TextBuffer {
 public:
  explicit TextBuffer(std::size_t expected_bytes) { text_.reserve(expected_bytes); }

  TextBuffer& operator<<(char c) {
    text_.push_back(c);
    return *this;
  }
  TextBuffer& operator<<(std::string_view text) {
    text_.append(text);
    return *this;
  }

  template <class Number>
  requires std::is_arithmetic_v<Number> TextBuffer& operator<<(Number number) {
    char digits[32];
    const auto [stop, error] = std::to_chars(digits, digits + sizeof digits, number);
    text_.append(digits, stop);
    return *this;
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// About so many bytes will a mesh take as text.
std::size_t expected_text_bytes(const MeshFile& file);

/// The comments, a line each, after a #.
void put_comments(TextBuffer& text, const MeshFile& file);

/// The properties of these names, in the order of the names; none unless all are there.
template <std::size_t N>
std::vector<const Property*> find_all(const std::vector<Property>& properties,
                                      const std::array<const char*, N>& names) {
  std::vector<const Property*> found;
  for (const char* name : names) {
    const auto at = std::find_if(properties.begin(), properties.end(),
                                 [&](const Property& property) { return property.name == name; });
    if (at == properties.end()) return {};
    found.push_back(&*at);
  }
  return found;
}

}  // namespace sphparam
