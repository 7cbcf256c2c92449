#include "io/attributes/other_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace sphparam {
namespace {

constexpr std::array<const char*, 4> colour_names = {"red", "green", "blue", "alpha"};
constexpr double most = 255;       // of a byte
constexpr double most_light = 16;  // of fractions that are brighter than white

Property* named(std::vector<Property>& properties, const std::string& name) {
  const auto found = std::ranges::find(properties, name, &Property::name);
  return found == properties.end() ? nullptr : &*found;
}

/// Whether there were any.
bool take_diffuse_names(std::vector<Property>& properties) {
  const auto is_colour = [](const Property& property) {
    return std::ranges::count(colour_names, property.name) > 0;
  };
  if (std::ranges::any_of(properties, is_colour)) return false;
  bool taken = false;
  for (const std::string name : colour_names) {
    Property* const diffuse = named(properties, "diffuse_" + name);
    if (!diffuse) continue;
    diffuse->name = name;
    taken = true;
  }
  return taken;
}

bool is_whole(double value) { return value == std::floor(value); }

double largest(const Property& property) {
  return property.values.empty() ? 0 : std::ranges::max(property.values);
}

/// Red, green and blue, of real numbers; none where they are not there.
std::vector<Property*> real_colours(std::vector<Property>& properties) {
  std::vector<Property*> colours;
  for (const char* const name : {"red", "green", "blue"}) {
    Property* const colour = named(properties, name);
    if (!colour || !is_floating(colour->type)) return {};
    colours.push_back(colour);
  }
  return colours;
}

bool are_whole(const std::vector<Property*>& colours) {
  return std::ranges::all_of(colours, [](const Property* colour) {
    return std::ranges::all_of(colour->values, is_whole);
  });
}

bool are_up_to_255(const std::vector<Property*>& colours, bool whole) {
  const auto in_range = [](double value) { return value >= 0 && value <= most; };
  const auto beyond = [](double value) {
    return [value](const Property* colour) { return largest(*colour) > value; };
  };
  return std::ranges::all_of(colours,
                             [&](const Property* colour) {
                               return std::ranges::all_of(colour->values, in_range);
                             }) &&
         ((whole && std::ranges::any_of(colours, beyond(1))) ||
          (std::ranges::all_of(colours, beyond(1)) &&
           std::ranges::any_of(colours, beyond(most_light))));
}

void become_bytes(Property& colour, bool whole) {
  colour.type = whole ? ScalarType::Uint8 : ScalarType::Float32;
  if (whole) return;
  for (double& value : colour.values) value = static_cast<double>(static_cast<float>(value / most));
}

/// Whether they went to 255.
bool take_real_bytes(std::vector<Property>& properties) {
  std::vector<Property*> colours = real_colours(properties);
  const bool whole = are_whole(colours);
  if (colours.empty() || !are_up_to_255(colours, whole)) return false;
  for (Property* const colour : colours) become_bytes(*colour, whole);
  Property* const alpha = named(properties, "alpha");
  if (!alpha || !is_floating(alpha->type)) return true;
  const bool whole_alpha = are_whole({alpha});
  if (are_up_to_255({alpha}, whole_alpha)) become_bytes(*alpha, whole_alpha);
  return true;
}

void take_other_colours(MeshFile& file, std::vector<Property>& properties,
                        const std::string& whose) {
  if (take_diffuse_names(properties))
    file.notes.push_back("diffuse_red, diffuse_green and diffuse_blue are the colours of " + whose);
  if (take_real_bytes(properties))
    file.notes.push_back("colours of " + whose + " are real numbers up to 255");
}

}  // namespace

void take_other_colours(MeshFile& file) {
  take_other_colours(file, file.vertex_properties, "vertices");
  take_other_colours(file, file.face_properties, "faces");
}

}  // namespace sphparam
