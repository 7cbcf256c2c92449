#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "texture/source_texture.h"
#include "texture/texture_seams.h"

namespace sphparam {

/// Texture coordinates of a bake's source with their seams, for all fields that look images up:
/// each kind is made once, when the first of them does. For one thread at a time.
class SourceCoordinates {
 public:
  using Coordinates = std::shared_ptr<const SeamedTexcoords>;

  /// The second ones of the file or the first; no rows where it has none. `by_material`: whether an
  /// image ends where the material does. Cost: that of `seamed`, once.
  Coordinates of(const MeshFile& file, bool second, bool by_material);

 private:
  std::map<std::pair<bool, bool>, Coordinates> known_;
};

/// Whether any has an image that lies on the second coordinates, or on the first.
bool has_image_on(const std::vector<SourceTexture>& textures, bool second);

}  // namespace sphparam
