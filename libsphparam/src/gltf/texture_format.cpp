// Each image on a thread of its own.

#include "sphparam/gltf/texture_format.h"

#include <algorithm>
#include <array>
#include <set>

#include "gltf/image_kind.h"
#include "image/image_codec.h"
#include "image/webp.h"
#include "number_text.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

constexpr int all_of_it = 100;  // quality

/// Images that are seen as colours and as nothing else.
std::set<int> colours_of(const Look& look) {
  std::set<int> colours;
  for (const Material& material : look.materials)
    colours.insert({material.base_colour, material.emissive});
  for (const Material& material : look.materials)
    for (const int other : {material.normal, material.occlusion, material.metallic_roughness})
      colours.erase(other);
  return colours;
}

/// The depth in the head of a PNG.
bool has_sixteen_bits(std::string_view bytes) {
  constexpr std::size_t depth = 24;
  return bytes.starts_with("\x89PNG") && bytes.size() > depth && bytes[depth] == 16;
}

std::string as_webp(const AssetImage& image, const WebpOptions& options) {
  const std::vector<char> bytes =
      encode_webp(decode_image({image.bytes.begin(), image.bytes.end()}, image.name), options);
  return {bytes.begin(), bytes.end()};
}

/// Replaces the bytes of an image, unless it is WebP already or none would be saved.
RecodedTexture recode(AssetImage& image, const WebpOptions& wanted, bool fallback) {
  RecodedTexture told{image.name, image.bytes.size(), image.bytes.size(), true, false};
  if (image_kind(image.bytes).is_webp()) return told;
  std::string webp = as_webp(image, wanted);
  if (webp.size() >= image.bytes.size()) return told;
  told.exact = wanted.lossless;
  told.sixteen_bits = has_sixteen_bits(image.bytes);
  told.bytes = webp.size();
  if (fallback) image.fallback = std::move(image.bytes);
  image.bytes = std::move(webp);
  return told;
}

std::string megabytes(std::size_t bytes) {
  return short_number(static_cast<double>(bytes) / 1e6) + " MB";
}

}  // namespace

std::vector<RecodedTexture> recode_textures(Look& look, const TextureOptions& options) {
  if (options.format == TextureFormat::Given) return {};
  const std::set<int> colours = colours_of(look);
  std::vector<RecodedTexture> recoded(look.images.size());
  parallel_for(std::ssize(look.images), 1, options.threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (std::int64_t i = first; i < last; ++i) {
                   const bool lossless =
                       options.quality >= all_of_it || !colours.contains(static_cast<int>(i));
                   const auto at = static_cast<std::size_t>(i);
                   recoded[at] = recode(look.images[at], {lossless, options.quality},
                                        options.fallback);
                 }
               });
  return recoded;
}

std::string words_of(const std::vector<RecodedTexture>& recoded) {
  if (recoded.empty()) return "";
  std::size_t before = 0, after = 0;
  for (const RecodedTexture& texture : recoded) {
    before += texture.given_bytes;
    after += texture.bytes;
  }
  return counted(std::ssize(recoded), "image", "images") + " as WebP: " + megabytes(after) +
         " of " + megabytes(before);
}

}  // namespace sphparam
