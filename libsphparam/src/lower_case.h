#pragma once

#include <string>
#include <string_view>

namespace sphparam {

/// Letters of ASCII in lower case, as keywords and names of files are compared; all other bytes as
/// they are, in every locale.
inline std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

}  // namespace sphparam
