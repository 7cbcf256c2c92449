#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "sphparam/image/image.h"
#include "sphparam/io/materials.h"
#include "sphparam/texture/texture_options.h"

namespace sphparam {

/// The levels of an image, each half as wide and high, in linear light; four channels a texel.
class TexturePyramid;

/// The texture of a material, as a mesh's own coordinates look it up: colours are
/// factor · image(s, t), t upwards. Copies share the pixels.
struct SourceTexture {
  std::shared_ptr<const TexturePyramid> image = nullptr;  // none: the factor alone
  TextureWrap wrap_s = TextureWrap::Repeat, wrap_t = TextureWrap::Repeat;
  std::array<float, 4> factor = {1, 1, 1, 1};             // linear red, green, blue, alpha
  TexturePlacement placement = {{{1, 0, 0}, {0, 1, 0}}};  // on the mesh's coordinates, t upwards
  bool second = false;                                    // on the second ones
  bool nearest = false;      // texels that are larger than samples are seen as they are
  std::string warning = {};  // what its image has that is not heeded; empty: nothing
};

/// The textures of a mesh: one a material of its file, or the first for all faces; empty: none.
struct MeshTextures {
  std::vector<SourceTexture> of_materials = {};
  bool one_for_all = false;  // whatever the materials
};

}  // namespace sphparam
