// What an image says of itself is what `bake` wrote into its metadata; strangers' say nothing.

#include "gltf/images/normal_image.h"

#include <algorithm>

#include "number_text.h"
#include "sphparam/io/paths.h"
#include "texture/baked_texts.h"

namespace sphparam {

std::string complaint_of_normals(const std::string& path, const GivenImage& image) {
  constexpr std::string_view wanted = "normal-tangent", down = "+Y down";
  const std::string name = display_name(path);
  const std::string_view field = baked_text(image.texts, "sphparam:map");
  if (!field.empty() && field != wanted)
    return name + " shows " + std::string(field) + ", and a normal map is of " +
           std::string(wanted) + ": `sphparam bake --map normal-tangent` makes it";
  if (baked_text(image.texts, "sphparam:about").find(down) != std::string_view::npos)
    return name +
           " is baked with +Y down (DirectX), and glTF has +Y up: `sphparam bake "
           "--normal-y gl` makes it so";
  constexpr int axes = 3;
  if (image.pixels.channels < axes)
    return name + " has " + counted(image.pixels.channels, "channel") +
           ", and a normal map has x, y and z, in red, green and blue";
  return {};
}

std::string warning_of_other_mesh(const std::string& path, const ImageTexts& texts,
                                  const std::vector<std::string>& names) {
  std::string_view noted = baked_text(texts, "sphparam:for");
  if (noted.empty()) noted = baked_text(texts, "sphparam:source");
  const std::string baked_for(noted);
  // A mesh and its map may be files of one name: statue.glb, statue.sph.ply.
  const auto is_it = [&](const std::string& name) { return stem_of(name) == stem_of(baked_for); };
  if (baked_for.empty() || std::ranges::any_of(names, is_it)) return {};
  return display_name(path) + ": baked for " + baked_for + ", not for " + names.front() +
         ": light falls wrong where that is another mesh or has another map, as a normal map is of "
         "one";
}

}  // namespace sphparam
