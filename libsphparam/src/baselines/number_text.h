#pragma once

#include <cstdio>
#include <string>

namespace sphparam {

/// Three digits, whatever the size: for statements.
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace sphparam
