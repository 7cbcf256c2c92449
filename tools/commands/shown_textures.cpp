#include "commands/shown_textures.h"

#include <algorithm>
#include <string_view>

#include "bake/make_scene.h"
#include "commands/command.h"
#include "console/paths.h"
#include "image/image_codec.h"
#include "io/attributes/appearance.h"

namespace sphparam::cli {

namespace {

MeshTextures image_for_all(const MeshFile& file, const std::string& path, const std::string& image,
                           int threads) {
  MeshTextures textures{.of_materials = {read_texture(image, TextureWrap::Repeat, threads)},
                        .one_for_all = true};
  if (has_texcoords(file)) return textures;
  throw UsageMistake("--texture: " + display_name(path) +
                     " has no texture coordinates, so its texture has no place");
}

bool has_image(const BaseColour& colour) { return !colour.image.empty(); }

/// What the glTF file said of its textures; empty where they are here, or never were.
std::string left_behind(const MeshFile& file) {
  if (!file.base_colours.empty() || !has_texcoords(file)) return "";
  const auto found = std::ranges::find_if(file.comments, [](std::string_view comment) {
    return comment.starts_with("base colour of ");
  });
  return found == file.comments.end() ? "" : *found;
}

}  // namespace

MeshTextures shown_textures(const MeshFile& file, const std::string& path, const std::string& image,
                            int threads, Console& console) {
  if (!image.empty()) return image_for_all(file, path, image, threads);
  const std::string name = display_name(path);
  if (const std::string words = left_behind(file); !words.empty()) {
    console.warning(name + ": shown without its texture, which is not in this file (" + words +
                    "): --texture IMAGE names it, or the glTF file with --sphere " + name +
                    " has it");
    return {};
  }
  if (std::ranges::any_of(file.base_colours, has_image) && !has_texcoords(file)) {
    console.warning(name + ": shown without its texture: there are no texture coordinates");
    return {};
  }
  try {
    return {.of_materials = read_textures(file, threads)};
  } catch (const ImageError& error) {
    console.warning(std::string(error.what()) + ": shown without");
    return {};
  }
}

}  // namespace sphparam::cli
