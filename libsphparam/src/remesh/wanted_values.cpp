#include "remesh/wanted_values.h"

#include <algorithm>

#include "io/attributes/corner_colours.h"
#include "sphparam/remesh/remesh.h"

namespace sphparam {

namespace {

using Names = std::vector<std::string>;

bool contains(const auto& names, const std::string& name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

constexpr const char* colour_names[] = {"red", "green", "blue", "alpha"};
const Names texcoords = {"s", "t"};
/// What belongs to the source's own numbering and map.
const Names not_carried = {"theta", "phi", "sx", "sy", "sz", "source_vertex", "source_face"};

std::string list_of(const MeshFile& source) {
  std::string names = "position";
  for (const auto* properties : {&source.vertex_properties, &source.face_properties}) {
    for (const Property& property : *properties) {
      if (!contains(not_carried, property.name) && !is_corner_colour(property.name))
        names += ", " + property.name;
    }
  }
  if (source.corner_texcoords) names += ", uv";
  if (source.corner_normals) names += ", normal";
  return names;
}

}  // namespace

bool is_colour_name(const std::string& name) { return contains(colour_names, name); }

WantedValues::WantedValues(const Names& words, const MeshFile& source) : words_(words) {
  const Names known = {"all", "none", "position", "color", "colour", "normal", "uv", "material"};
  for (const std::string& word : words) {
    if (contains(known, word) || source.find_vertex_property(word) ||
        (source.find_face_property(word) && !is_corner_colour(word))) {
      continue;
    }
    throw NoSuchProperty("no property " + word + " to transfer; there are " + list_of(source));
  }
}

bool WantedValues::property(const std::string& name) const {
  if (contains(not_carried, name) || is_corner_colour(name)) return false;
  const auto group = [&](const auto& names, const char* word) {
    return contains(names, name) && contains(words_, word);
  };
  return contains(words_, "all") || contains(words_, name) || group(colour_names, "color") ||
         group(colour_names, "colour") || group(normal_names, "normal") || group(texcoords, "uv");
}

bool WantedValues::corner_texcoords() const {
  return contains(words_, "all") || contains(words_, "uv");
}

bool WantedValues::corner_normals() const {
  return contains(words_, "all") || contains(words_, "normal");
}

}  // namespace sphparam
