#pragma once

#include <algorithm>
#include <string_view>

namespace sphparam {

/// The text up to the next blank, which is taken off the front with it.
inline std::string_view take_word(std::string_view& text) {
  const std::size_t blank = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, blank);
  text.remove_prefix(std::min(blank + 1, text.size()));
  return word;
}

}  // namespace sphparam
