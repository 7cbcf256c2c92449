#include "bake/source_coordinates.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "io/attributes/appearance.h"

namespace sphparam {

SourceCoordinates::Coordinates SourceCoordinates::of(const MeshFile& file, bool second,
                                                     bool by_material) {
  Coordinates& known = known_[{second, by_material}];
  if (known) return known;
  std::optional<CornerTexcoords> corners = second ? file.second_texcoords : texcoords_of(file);
  known = std::make_shared<const SeamedTexcoords>(
      corners ? seamed(file.mesh.triangles, *std::move(corners),
                       by_material ? file.find_face_property("material") : nullptr)
              : SeamedTexcoords{});
  return known;
}

bool has_image_on(const std::vector<SourceTexture>& textures, bool second) {
  return std::ranges::any_of(
      textures, [second](const auto& t) { return t.image != nullptr && t.second == second; });
}

}  // namespace sphparam
