#include "io/formats/three_mf/three_mf_colours.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "number_text.h"
#include "sphparam/io/losses.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

constexpr std::array channels = {"red", "green", "blue", "alpha"};
constexpr std::uint8_t full = 255;

}  // namespace

int ThreeMfColours::number_of(std::pair<std::string, Colour> material) {
  const auto [at, is_new] = numbers_.try_emplace(material, static_cast<int>(materials_.size()));
  if (is_new) materials_.push_back(std::move(material));
  return at->second;
}

void ThreeMfColours::add(const ThreeMfPaint& paint, const ThreeMfGroups& groups,
                         const std::string& name) {
  constexpr Colour white = {full, full, full, full};
  corners_.push_back({white, white, white});
  is_painted_.push_back(0);
  material_of_.push_back(-1);
  const auto found = groups.find(paint.group);
  if (found == groups.end()) return;
  const ThreeMfGroup& group = found->second;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t i = paint.index[k];
    if (i < 0 || i >= std::ssize(group.colours))
      throw ReadError(name, "a triangle has entry " + std::to_string(i) + " of a group of " +
                                counted(std::ssize(group.colours), "colour"));
    if (!group.is_material) corners_.back()[k] = group.colours[static_cast<std::size_t>(i)];
  }
  is_painted_.back() = !group.is_material;
  if (!group.is_material) return;
  const auto first = static_cast<std::size_t>(paint.index[0]);
  material_of_.back() = number_of({group.names[first], group.colours[first]});
}

void ThreeMfColours::attach_to(MeshFile& file) const {
  attach_materials(file);
  if (std::ranges::find(is_painted_, 1) == is_painted_.end()) return;
  const auto plain = std::ranges::count(is_painted_, 0);
  if (plain > 0)
    file.notes.push_back(counted(plain, "triangle has", "triangles have") +
                         " no colour, and became white");
  if (!attach_to_vertices(file)) attach_to_faces(file);
}

void ThreeMfColours::attach_materials(MeshFile& file) const {
  if (materials_.empty()) return;
  file.set_face_property(
      {"material", ScalarType::Int32, {material_of_.begin(), material_of_.end()}});
  for (const auto& [name, colour] : materials_) {
    MaterialTexture look;
    for (std::size_t i = 0; i < 3; ++i)
      look.factor[i] = SrgbCurves::get().to_linear(static_cast<float>(colour[i]) / full);
    look.factor[3] = colour[3] / double{full};
    file.materials.push_back(name);
    file.base_colours.push_back(look);
  }
  file.channels.resize(materials_.size());
}

/// Without alpha where all is opaque.
std::size_t ThreeMfColours::channels_used() const {
  const bool is_opaque = std::ranges::all_of(corners_, [](const auto& corners) {
    return std::ranges::all_of(corners, [](const Colour& colour) { return colour[3] == full; });
  });
  return is_opaque ? 3 : 4;
}

/// False where a vertex has two colours.
bool ThreeMfColours::attach_to_vertices(MeshFile& file) const {
  std::vector<std::optional<Colour>> of(static_cast<std::size_t>(file.mesh.vertex_count()));
  for (std::size_t f = 0; f < corners_.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto& colour = of[static_cast<std::size_t>(
          file.mesh.triangles(static_cast<Face>(f), static_cast<int>(k)))];
      if (colour && *colour != corners_[f][k]) return false;
      colour = corners_[f][k];
    }
  }
  for (std::size_t i = 0; i < channels_used(); ++i) {
    Property channel{channels[i], ScalarType::Uint8, {}};
    for (const auto& colour : of) channel.values.push_back(colour ? (*colour)[i] : full);
    file.set_vertex_property(std::move(channel));
  }
  return true;
}

void ThreeMfColours::attach_to_faces(MeshFile& file) const {
  for (std::size_t i = 0; i < channels_used(); ++i) {
    Property channel{channels[i], ScalarType::Uint8, {}};
    for (const auto& c : corners_)
      channel.values.push_back(std::round((c[0][i] + c[1][i] + c[2][i]) / 3.0));
    file.set_face_property(std::move(channel));
  }
  const auto mixed =
      std::ranges::count_if(corners_, [](const auto& c) { return c[0] != c[1] || c[1] != c[2]; });
  if (mixed > 0)
    add_loss(file.notes,
             "colours within " + counted(mixed, "triangle") + ", of which the mean is kept");
}

}  // namespace sphparam
