#include "io/attributes/whole_vector.h"

#include <algorithm>
#include <array>
#include <string>

namespace sphparam {
namespace {

using Names = std::vector<std::string_view>;

/// What one needs.
const std::array<Names, 3> vectors = {
    Names{"nx", "ny", "nz"}, {"s", "t"}, {"red", "green", "blue"}};

bool contains(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

bool is_of_whole_vector(std::string_view name, const std::vector<Property>& properties) {
  const std::string_view needed = name == "alpha" ? "red" : name;
  const auto is_there = [&](std::string_view component) {
    return std::ranges::find(properties, component, &Property::name) != properties.end();
  };
  return std::ranges::any_of(vectors, [&](const Names& names) {
    return contains(names, needed) && std::ranges::all_of(names, is_there);
  });
}

}  // namespace sphparam
