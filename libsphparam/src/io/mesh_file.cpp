#include "sphparam/io/mesh_file.h"

#include <algorithm>

#include "io/attributes/corner_colours.h"

namespace sphparam {
namespace {

template <class Properties>
auto find(Properties& properties, const std::string& name) {
  return std::find_if(properties.begin(), properties.end(),
                      [&](const Property& property) { return property.name == name; });
}

const Property* find_or_null(const std::vector<Property>& properties, const std::string& name) {
  const auto found = find(properties, name);
  return found == properties.end() ? nullptr : &*found;
}

void add_or_replace(std::vector<Property>& properties, Property property) {
  const auto found = find(properties, property.name);
  if (found == properties.end())
    properties.push_back(std::move(property));
  else
    *found = std::move(property);
}

}  // namespace

const Property* MeshFile::find_vertex_property(const std::string& name) const {
  return find_or_null(vertex_properties, name);
}

const Property* MeshFile::find_face_property(const std::string& name) const {
  return find_or_null(face_properties, name);
}

void MeshFile::set_vertex_property(Property property) {
  // A colour that is set is that of all corners.
  const std::string& name = property.name;
  if (name == "red" || name == "green" || name == "blue" || name == "alpha")
    remove_corner_colours(*this);
  add_or_replace(vertex_properties, std::move(property));
}

void MeshFile::set_face_property(Property property) {
  add_or_replace(face_properties, std::move(property));
}

void remove_properties(std::vector<Property>& properties, const std::vector<std::string>& names) {
  std::erase_if(properties, [&](const Property& property) {
    return std::find(names.begin(), names.end(), property.name) != names.end();
  });
}

std::string one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\0'; }, ' ');
  return line;
}

}  // namespace sphparam
