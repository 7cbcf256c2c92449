#include "texture/read_textures.h"

#include <algorithm>
#include <stdexcept>

#include "image/image_codec.h"
#include "io/formats/gltf/gltf_files.h"
#include "sphparam/io/paths.h"
#include "texture/texture_pyramid.h"

namespace sphparam {
namespace {

constexpr std::uint64_t most_image_bytes = std::uint64_t{2} << 30;

TextureWrap wrap_of(Wrapping wrapping) {
  if (wrapping == Wrapping::Clamp) return TextureWrap::Clamp;
  return wrapping == Wrapping::Mirror ? TextureWrap::Mirror : TextureWrap::Repeat;
}

std::vector<char> bytes_of(const MaterialTexture& colour) {
  if (colour.bytes) return *colour.bytes;
  const std::vector<unsigned char> read = read_below(colour.folder, colour.path, most_image_bytes);
  return {read.begin(), read.end()};
}

/// Throws ImageError.
std::shared_ptr<const TexturePyramid> decode(const MaterialTexture& colour, const std::string& what,
                                             bool linear, int threads) {
  if (!colour.problem.empty()) throw ImageError(what + ": " + colour.problem);
  std::vector<char> bytes;
  try {
    bytes = bytes_of(colour);
  } catch (const std::runtime_error& error) {
    throw ImageError(what + " cannot be read: " + error.what());
  }
  return std::make_shared<const TexturePyramid>(decode_image(bytes, what), linear, threads);
}

}  // namespace

std::string why_unusable(const MaterialTexture& texture) try {
  if (texture.image.empty()) return "";
  if (!texture.problem.empty()) return texture.problem;
  return is_image(bytes_of(texture)) ? "" : "its format is not read";
} catch (const std::runtime_error& error) {
  return error.what();
}

SourceTexture read_texture(const std::string& path, TextureWrap wrap, int threads) {
  const bool linear = extension_of(path) == ".exr";
  return {.image = std::make_shared<const TexturePyramid>(read_image(path), linear, threads),
          .wrap_s = wrap,
          .wrap_t = wrap};
}

SourceTexture TextureReader::read(const MaterialTexture& said, const std::string& material) {
  SourceTexture texture{.image = nullptr,
                        .wrap_s = wrap_of(said.wrap_s),
                        .wrap_t = wrap_of(said.wrap_t),
                        .placement = said.placement};
  std::ranges::transform(said.factor, texture.factor.begin(),
                         [](double x) { return static_cast<float>(x); });
  if (said.image.empty()) return texture;
  auto& image = decoded_[said.image];
  const std::string what = "material " + material + ", " + said.image;
  if (!image) image = decode(said, what, kind_ == TexelKind::Number, threads_);
  texture.image = image;
  return texture;
}

std::vector<SourceTexture> TextureReader::read(MaterialTexture MaterialChannels::*channel) {
  std::vector<SourceTexture> textures;
  for (size_t i = 0; i < file_.channels.size(); ++i)
    textures.push_back(read(file_.channels[i].*channel, file_.materials[i]));
  return textures;
}

std::vector<SourceTexture> read_textures(const MeshFile& file, int threads) {
  TextureReader reader(file, TexelKind::Colour, threads);
  std::vector<SourceTexture> textures;
  for (size_t i = 0; i < file.base_colours.size(); ++i)
    textures.push_back(reader.read(file.base_colours[i], file.materials[i]));
  return textures;
}

}  // namespace sphparam
