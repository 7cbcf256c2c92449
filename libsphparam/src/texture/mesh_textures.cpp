#include "sphparam/texture/mesh_textures.h"

#include <algorithm>
#include <vector>

#include "image/image_codec.h"
#include "io/attributes/appearance.h"
#include "io/attributes/material_comments.h"
#include "texture/read_textures.h"

namespace sphparam {

namespace {

ShownTextures shown(MeshTextures textures) {
  return {.textures = std::make_shared<const MeshTextures>(std::move(textures))};
}

ShownTextures shown_without(const std::string& why, bool left_behind = false) {
  return {std::make_shared<const MeshTextures>(), why, left_behind};
}

bool has_image(const MaterialTexture& colour) { return !colour.image.empty(); }

/// A material of some face that lets through what is behind it; empty: none does.
std::string see_through(const MeshFile& file) {
  const Property* const material = file.find_face_property("material");
  const std::size_t count = std::min(file.channels.size(), file.materials.size());
  if (!material || count == 0) return "";
  std::vector<char> used(count, 0);
  for (const double id : material->values)
    if (id >= 0 && id < static_cast<double>(count)) used[static_cast<std::size_t>(id)] = 1;
  for (std::size_t i = 0; i < count; ++i)
    if (used[i] && file.channels[i].alpha_mode != AlphaMode::Opaque) return file.materials[i];
  return "";
}

}  // namespace

ShownTextures shown_textures(const MeshFile& file, const std::string& name,
                             const std::string& image, int threads) {
  if (!image.empty()) {
    const SourceTexture texture = read_texture(file, image, TextureWrap::Repeat, threads);
    if (has_texcoords(file)) {
      ShownTextures result = shown({.of_materials = {texture}, .one_for_all = true});
      result.warning = texture.warning;
      return result;
    }
    throw NoTexcoords(name + " has no texture coordinates, so its texture has no place");
  }
  if (const std::string words = left_behind_texture(file); !words.empty()) {
    return shown_without(
        name + ": shown without its texture, which is not in this file (" + words + ")", true);
  }
  if (std::ranges::any_of(file.base_colours, has_image) && !has_texcoords(file))
    return shown_without(name + ": shown without its texture: there are no texture coordinates");
  try {
    ShownTextures result = shown({.of_materials = read_textures(file, threads)});
    if (const std::string material = see_through(file); !material.empty())
      result.warning = name + ": shown opaque: pictures have no transparency, as its material '" +
                       material + "' has";
    for (const std::string& warning : warnings_of(result.textures->of_materials))
      result.warning += (result.warning.empty() ? "" : "; ") + warning;
    return result;
  } catch (const ImageError& error) {
    return shown_without(std::string(error.what()) + ": shown without");
  }
}

}  // namespace sphparam
