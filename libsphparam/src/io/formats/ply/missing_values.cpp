#include "io/formats/ply/missing_values.h"

#include <algorithm>
#include <set>

#include "io/formats/non_finite_numbers.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/read_options.h"

namespace sphparam {
namespace {

/// The properties that are one thing with this one, itself among them.
std::vector<std::string> components_beside(const std::string& name) {
  static const std::vector<std::vector<std::string>> vectors = {{"nx", "ny", "nz"},
                                                                {"red", "green", "blue", "alpha"},
                                                                {"s", "t"},
                                                                {"u", "v"},
                                                                {"texture_u", "texture_v"}};
  const auto is_component = [&](const auto& names) { return std::ranges::count(names, name) > 0; };
  const auto found = std::ranges::find_if(vectors, is_component);
  return found == vectors.end() ? std::vector{name} : *found;
}

bool is_of_rays(const std::string& property) {
  return property == "sx" || property == "sy" || property == "sz";
}

}  // namespace

void leave_out_non_finite(std::vector<Property>& properties, bool of_vertices,
                          const std::string& name, std::vector<std::string>& notes) {
  std::set<std::string> left_out;
  for (const Property& property : properties) {
    const std::string why = non_finite_words(property.values);
    if (why.empty()) continue;
    const std::string what = "property " + sphparam::quoted(property.name) + " of element " +
                             sphparam::quoted(of_vertices ? "vertex" : "face") + ": " + why;
    if (of_vertices && is_of_rays(property.name)) throw ReadError(name, what);
    const std::vector<std::string> together = components_beside(property.name);
    add_loss(notes, what + (together.size() > 1 ? "; " + joined(together) + " go together" : ""));
    left_out.insert(together.begin(), together.end());
  }
  std::erase_if(properties,
                [&](const Property& property) { return left_out.contains(property.name); });
}

}  // namespace sphparam
