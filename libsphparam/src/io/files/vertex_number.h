#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/text_scanner.h"
#include "sphparam/errors.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

inline bool is_whole_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of("+-0123456789") == std::string_view::npos;
}

/// The number of a vertex that stands next on a line, negative ones included. Throws: ReadError
/// that ends with what such a line is.
inline long vertex_number(TextScanner& scanner, std::string_view line_is) {
  const std::string_view word = scanner.peek_word();
  if (!is_whole_number(word))
    scanner.fail("expected a whole number, found " +
                 (word.empty() ? std::string("the end of the line") : quoted(word)) +
                 ": a line is " + std::string(line_is));
  return scanner.integer();
}

/// Words on the rest of a line, without a comment.
inline std::vector<std::string_view> words_ahead(const TextScanner& scanner) {
  std::string_view rest = scanner.peek_rest();
  rest = rest.substr(0, rest.find('#'));
  constexpr std::string_view blanks = " \t\r\v\f";
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = rest.find_first_not_of(blanks, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(rest.find_first_of(blanks, at), rest.size());
    words.push_back(rest.substr(at, end - at));
    at = end;
  }
  return words;
}

/// Three coordinates that stand next. Throws: ReadError.
inline Vector3 point_in(TextScanner& scanner) {
  const double x = scanner.real(), y = scanner.real();
  return {x, y, scanner.real()};
}

}  // namespace sphparam
