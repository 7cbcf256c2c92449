#include "io/attributes/corner_colours.h"

#include <array>
#include <cmath>

namespace sphparam {
namespace {

constexpr std::array channels = {"red", "green", "blue", "alpha"};

std::string name_of(int channel, int corner) {
  return std::string("corner_") + channels[static_cast<std::size_t>(channel)] + "_" +
         std::to_string(corner);
}

}  // namespace

bool is_corner_colour(const std::string& property) {
  for (int channel = 0; channel < 4; ++channel)
    for (int corner = 0; corner < 3; ++corner)
      if (property == name_of(channel, corner)) return true;
  return false;
}

std::optional<CornerColours> corner_colours(const MeshFile& file) {
  if (!file.find_vertex_property(channels[0])) return std::nullopt;
  CornerColours colours = CornerColours::Zero(3 * file.mesh.face_count(), 4);
  for (int channel = 0; channel < 4; ++channel) {
    for (int corner = 0; corner < 3; ++corner) {
      const Property* const property = file.find_face_property(name_of(channel, corner));
      if (!property && channel == 3) return colours;
      if (!property) return std::nullopt;
      for (Eigen::Index f = 0; f < file.mesh.face_count(); ++f)
        colours(3 * f + corner, channel) = property->values[static_cast<std::size_t>(f)];
    }
  }
  return colours;
}

void set_corner_colours(MeshFile& file, const CornerColours& colours) {
  for (int channel = 0; channel < 4; ++channel) {
    const Property* const vertices =
        file.find_vertex_property(channels[static_cast<std::size_t>(channel)]);
    for (int corner = 0; vertices && corner < 3; ++corner) {
      Property property{name_of(channel, corner), vertices->type, {}};
      const bool whole = !is_floating(property.type);
      for (Eigen::Index f = 0; f < file.mesh.face_count(); ++f) {
        const double value = colours(3 * f + corner, channel);
        property.values.push_back(whole ? std::round(value) : value);
      }
      file.set_face_property(std::move(property));
    }
  }
}

void remove_corner_colours(MeshFile& file) {
  std::erase_if(file.face_properties,
                [](const Property& property) { return is_corner_colour(property.name); });
}

}  // namespace sphparam
