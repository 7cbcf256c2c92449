#include "io/shell_word.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace sphparam {

std::string shell_word(const std::string& name) {
  constexpr std::string_view harmless = "._-/+:@%,=";
  const auto plain = [&](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 || harmless.find(static_cast<char>(c)) < harmless.size();
  };
  if (std::all_of(name.begin(), name.end(), plain)) return name;
  std::string result = "'";
  for (const char c : name) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string shell_file(const std::string& path) {
  const bool like_option = path.size() > 1 && path.starts_with('-');
  return shell_word(like_option ? "./" + path : path);
}

}  // namespace sphparam
