#include "remesh/wanted_values.h"

#include <algorithm>

#include "io/attributes/corner_colours.h"
#include "io/attributes/mixed_colour.h"
#include "io/match_targets.h"
#include "sphparam/remesh/remesh.h"

namespace sphparam {

namespace {

using Names = std::vector<std::string>;

bool contains(const auto& names, const std::string& name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

const Names texcoords = {"s", "t"};
/// What belongs to the source's own numbering and map.
const Names not_carried = {"theta", "phi", "sx", "sy", "sz", "source_vertex", "source_face"};

/// With a comma in front of each.
std::string names_of(const std::vector<Property>& properties) {
  std::string names;
  for (const Property& property : properties)
    if (!contains(not_carried, property.name) && !is_corner_colour(property.name))
      names += ", " + property.name;
  return names;
}

std::string list_of(const MeshFile& source) {
  std::string names =
      "position" + names_of(source.vertex_properties) + names_of(source.face_properties);
  if (source.corner_texcoords) names += ", uv";
  if (source.corner_normals) names += ", normal";
  return names;
}

}  // namespace

WantedValues::WantedValues(const Names& words, const MeshFile& source)
    : words_(words), is_matched_(has_match_targets(source)) {
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
  if (is_matched_ && is_match_target(name)) return false;
  const auto group = [&](const auto& names, const char* word) {
    return contains(names, name) && contains(words_, word);
  };
  const bool of_colour =
      is_colour_name(name) && (contains(words_, "color") || contains(words_, "colour"));
  return contains(words_, "all") || contains(words_, name) || of_colour ||
         group(normal_names, "normal") || group(texcoords, "uv");
}

void WantedValues::require_image(const std::string& what, const MeshFile& source) const {
  // A fitted surface has normals of its own.
  if (what == "position" || what == "normal" || contains(normal_names, what)) return;
  const bool is_colour = what == "color" || what == "colour";
  for (const std::string& name : is_colour ? Names{"red", "green", "blue"} : Names{what}) {
    const bool is_there = source.find_vertex_property(name) != nullptr;
    if (is_there && property(name)) continue;
    throw NoSuchProperty(is_there ? what + " is not among what is transferred"
                         : source.find_face_property(name)
                             ? what + " is of faces: images are of what vertices have"
                             : "vertices have no " + what + "; there are position, normal" +
                                   names_of(source.vertex_properties));
  }
}

bool WantedValues::corner_texcoords() const {
  return contains(words_, "all") || contains(words_, "uv");
}

bool WantedValues::corner_normals() const {
  return contains(words_, "all") || contains(words_, "normal");
}

}  // namespace sphparam
