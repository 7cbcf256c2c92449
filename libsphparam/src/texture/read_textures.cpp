#include "texture/read_textures.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "image/image_codec.h"
#include "io/attributes/material_comments.h"
#include "io/formats/gltf/gltf_files.h"
#include "number_text.h"
#include "sphparam/io/paths.h"
#include "texture/baked_texts.h"
#include "texture/seen_by_mesh.h"
#include "texture/specular_glossiness_image.h"
#include "texture/texture_pyramid.h"

namespace sphparam {
namespace {

constexpr std::uint64_t most_image_bytes = std::uint64_t{2} << 30;

std::vector<char> bytes_of(const MaterialTexture& colour) {
  if (colour.bytes) return *colour.bytes;
  const std::vector<unsigned char> read = read_below(colour.folder, colour.path, most_image_bytes);
  return {read.begin(), read.end()};
}

bool is_grey(const Image& image) {
  if (image.channels < 3) return true;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* texel = image.pixel(x, y);
      if (texel[0] != texel[1] || texel[0] != texel[2]) return false;
    }
  }
  return true;
}

/// A texel beyond the border, where the image goes on.
int wrapped(int i, int size, Wrapping wrapping) {
  if (wrapping == Wrapping::Repeat) return (i + size) % size;
  return std::clamp(i, 0, size - 1);  // of a mirror, the texel beside the border is that at it
}

/// Normals of the surface (x, y, bump · height), x to the right, y up the image, by central
/// differences.
Image normals_of_heights(const Image& heights, const MaterialTexture& said) {
  Image normals(heights.width, heights.height, 3);
  const auto height = [&](int x, int y) {
    return said.bump *
           static_cast<double>(heights.pixel(wrapped(x, heights.width, said.wrap_s),
                                             wrapped(y, heights.height, said.wrap_t))[0]);
  };
  for (int y = 0; y < heights.height; ++y) {
    for (int x = 0; x < heights.width; ++x) {
      const Vector3 normal = Vector3((height(x - 1, y) - height(x + 1, y)) / 2,
                                     (height(x, y + 1) - height(x, y - 1)) / 2, 1)
                                 .normalized();
      for (int c = 0; c < 3; ++c)
        normals.pixel(x, y)[c] = static_cast<float>(0.5 + 0.5 * normal[c]);
    }
  }
  return normals;
}

/// Throws ImageError.
void require_no_problem(const MaterialTexture& texture, const std::string& what) {
  if (!texture.problem.empty()) throw ImageError(what + ": " + texture.problem);
}

/// Throws ImageError.
std::vector<char> bytes_of(const MaterialTexture& texture, const std::string& what) {
  require_no_problem(texture, what);
  try {
    return bytes_of(texture);
  } catch (const std::runtime_error& error) {
    throw ImageError(what + " cannot be read: " + error.what());
  }
}

/// Throws ImageError.
Image image_of(const MaterialTexture& texture, const std::string& what) {
  return texture.image.empty() ? Image() : decode_image(bytes_of(texture, what), what);
}

/// Throws ImageError.
DecodedTexture decode(const MeshFile& file, const MaterialTexture& colour, const std::string& what,
                      TexelKind kind, int threads) {
  bool linear = kind == TexelKind::Number;
  Image image;
  ImageTexts texts;
  if (const auto& parts = colour.made_of) {
    image = metallic_roughness_image(*parts, image_of(parts->diffuse, what),
                                     image_of(parts->specular, what), linear, threads);
  } else {
    const std::vector<char> bytes = bytes_of(colour, what);
    image = decode_image(bytes, what, {}, &texts);
    linear |= has_float_samples(texts);
  }
  const bool heights = colour.bump != 0 && is_grey(image);
  if (heights) image = normals_of_heights(image, colour);
  const SeenTexels seen = seen_texels(file, origin_of(colour), image.width, image.height, threads);
  return {std::make_shared<const TexturePyramid>(image, linear, threads, seen), heights,
          file_warning(colour.image, texts, kind)};
}

/// Programs differ on floats of these; of an EXR they agree.
bool is_strangers_tiff(const std::string& image, const ImageTexts& texts) {
  const std::string extension = extension_of(image);
  return (extension == ".tif" || extension == ".tiff") && baked_text(texts, "sphparam:map").empty();
}

/// As `note_nearest` has it.
std::string_view noted_name(MaterialTexture MaterialChannels::*channel) {
  static constexpr std::pair<MaterialTexture MaterialChannels::*, std::string_view> names[] = {
      {&MaterialChannels::roughness, "roughness"},
      {&MaterialChannels::metallic, "metallic"},
      {&MaterialChannels::occlusion, "occlusion"},
      {&MaterialChannels::normal, "normal"},
      {&MaterialChannels::emission, "emissive"}};
  for (const auto& [member, name] : names)
    if (member == channel) return name;
  return "opacity";
}

}  // namespace

std::string why_unusable(const MaterialTexture& texture) try {
  if (texture.image.empty()) return "";
  if (!texture.problem.empty()) return texture.problem;
  if (const auto& parts = texture.made_of) {
    const std::string why = why_unusable(parts->diffuse);
    return why.empty() ? why_unusable(parts->specular) : why;
  }
  const std::vector<char> bytes = bytes_of(texture);
  if (!is_image(bytes)) return "its format is not read";
  decode_image(bytes, "broken");
  return "";
} catch (const std::runtime_error& error) {
  const std::string why = error.what();
  return why.substr(0, why.find('\n'));
}

std::string file_warning(const std::string& image, const ImageTexts& texts, TexelKind kind,
                         const std::string& more) {
  const bool is_colour = kind == TexelKind::Colour, is_float = has_float_samples(texts);
  std::vector<std::string> words;
  const std::string_view profile = baked_text(texts, other_profile_text);
  if (is_colour && !is_float && !profile.empty())
    words.push_back("its colours are taken as sRGB; its colour profile, " + std::string(profile) +
                    ", is not heeded (convert the image to sRGB)");
  if (!baked_text(texts, lacks_end_text).empty())
    words.emplace_back("the end of the file is missing, but none of the pixels (save it again)");
  if (is_measured(texts))
    words.push_back("its pixels are what was measured (" +
                    std::string(baked_text(texts, "sphparam:about")) +
                    "), and taken as colours; a PNG of it is scaled from dark to bright");
  if (is_colour && is_float && is_strangers_tiff(image, texts))
    words.emplace_back("its colours are floats, which are taken as linear light, as an EXR's are");
  if (!more.empty()) words.push_back(more);
  return words.empty() ? "" : image + ": " + joined(words, "; ");
}

std::vector<std::string> warnings_of(const std::vector<SourceTexture>& textures) {
  std::vector<std::string> warnings;
  for (const SourceTexture& texture : textures)
    if (!texture.warning.empty() && std::ranges::find(warnings, texture.warning) == warnings.end())
      warnings.push_back(texture.warning);
  return warnings;
}

TextureWrap wrap_of(Wrapping wrapping) {
  if (wrapping == Wrapping::Clamp) return TextureWrap::Clamp;
  return wrapping == Wrapping::Mirror ? TextureWrap::Mirror : TextureWrap::Repeat;
}

ImageOrigin origin_of(const MaterialTexture& texture) {
  return {texture.folder, texture.path, texture.bytes, texture.made_of};
}

SourceTexture read_texture(const MeshFile& file, const std::string& path, TextureWrap wrap,
                           int threads) {
  ImageTexts texts;
  const Image image = read_image(path, {}, &texts);
  const bool linear = has_float_samples(texts);
  const SeenTexels seen = seen_texels(file, wrap, image.width, image.height, threads);
  return {.image = std::make_shared<const TexturePyramid>(image, linear, threads, seen),
          .wrap_s = wrap,
          .wrap_t = wrap,
          .warning = file_warning(path, texts, TexelKind::Colour)};
}

SourceTexture TextureReader::read(const MaterialTexture& said, const std::string& material) {
  SourceTexture texture{.image = nullptr,
                        .wrap_s = wrap_of(said.wrap_s),
                        .wrap_t = wrap_of(said.wrap_t),
                        .placement = said.placement,
                        .second = said.second};
  std::ranges::transform(said.factor, texture.factor.begin(),
                         [](double x) { return static_cast<float>(x); });
  if (said.image.empty()) return texture;
  const std::string what = "material " + material + ", " + said.image;
  require_no_problem(said, what);
  const bool wraps_count = said.bump != 0;
  DecodedTexture& decoded =
      decoded_[{origin_of(said), said.bump, wraps_count ? said.wrap_s : Wrapping::Repeat,
                wraps_count ? said.wrap_t : Wrapping::Repeat}];
  if (!decoded.image) decoded = decode(file_, said, what, kind_, threads_);
  texture.image = decoded.image;
  texture.warning = decoded.warning;
  if (decoded.heights) texture.factor[1] = 1;  // whatever was said of the green of normals
  if (said.bump != 0 && !decoded.heights) texture.factor[0] = static_cast<float>(said.bump);
  return texture;
}

std::vector<SourceTexture> TextureReader::read(MaterialTexture MaterialChannels::*channel) {
  std::vector<SourceTexture> textures;
  for (size_t i = 0; i < file_.channels.size(); ++i) {
    textures.push_back(read(file_.channels[i].*channel, file_.materials[i]));
    textures.back().nearest = is_noted_nearest(file_, i, noted_name(channel));
  }
  return textures;
}

std::vector<SourceTexture> read_textures(const MeshFile& file, int threads) {
  TextureReader reader(file, TexelKind::Colour, threads);
  std::vector<SourceTexture> textures;
  for (size_t i = 0; i < file.base_colours.size(); ++i) {
    textures.push_back(reader.read(file.base_colours[i], file.materials[i]));
    textures.back().nearest = is_noted_nearest(file, i, "base colour");
  }
  return textures;
}

}  // namespace sphparam
