#pragma once

#include <string>

namespace sphparam {

/// The name; where `is_taken` says so of it, the first of NAME_2, NAME_3 … of which it does not.
template <class IsTaken>
std::string free_name(const std::string& name, const IsTaken& is_taken) {
  if (!is_taken(name)) return name;
  int number = 2;
  while (is_taken(name + "_" + std::to_string(number))) ++number;
  return name + "_" + std::to_string(number);
}

/// With '_' for blanks and what is not ASCII: some formats have neither in names of properties.
inline std::string printable_name(std::string name) {
  for (char& c : name)
    if (c <= ' ' || c > '~') c = '_';
  return name;
}

}  // namespace sphparam
