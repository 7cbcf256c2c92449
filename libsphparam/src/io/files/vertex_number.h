#pragma once

#include <string>
#include <string_view>

#include "io/files/text_scanner.h"
#include "sphparam/errors.h"

namespace sphparam {

/// The number of a vertex that stands next on a line, negative ones included. Throws: ReadError
/// that ends with what such a line is.
inline long vertex_number(TextScanner& scanner, std::string_view line_is) {
  const std::string_view word = scanner.peek_word();
  if (word.empty() || word.find_first_not_of("+-0123456789") != std::string_view::npos)
    scanner.fail("expected a whole number, found " +
                 (word.empty() ? std::string("the end of the line") : quoted(word)) +
                 ": a line is " + std::string(line_is));
  return scanner.integer();
}

}  // namespace sphparam
