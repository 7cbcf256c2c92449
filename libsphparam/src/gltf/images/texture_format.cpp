// Each image on a thread of its own; whatever is not smaller is not taken.

#include "gltf/images/texture_format.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "gltf/images/image_kind.h"
#include "image/image_codec.h"
#include "image/webp.h"
#include "number_text.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

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

bool is_webp(TextureFormat format) {
  return format == TextureFormat::Webp || format == TextureFormat::WebpLossless;
}

/// Without the alpha of an image that is opaque all over.
Image without_opaque_alpha(const Image& image) {
  Image opaque(image.width, image.height, 3);
  for (std::size_t i = 0; i < image.pixels.size() / 4; ++i) {
    if (image.pixels[4 * i + 3] != 1) return image;
    std::copy_n(&image.pixels[4 * i], 3, &opaque.pixels[3 * i]);
  }
  return opaque;
}

struct Encoded {
  std::string bytes;
  bool exact;
};

Encoded encoded(const std::vector<char>& bytes, bool exact) {
  return {{bytes.begin(), bytes.end()}, exact};
}

/// Nothing where there is alpha.
std::optional<Encoded> as_jpeg(const Image& given) {
  const Image image = given.channels == 4 ? without_opaque_alpha(given) : given;
  if (image.channels % 2 == 0) return std::nullopt;
  return encoded(encode_image(image, ImageFormat::Jpeg), false);
}

/// Of few colours, what loses nothing is the smaller one.
Encoded as_webp(const Image& image, bool may_lose, int quality) {
  Encoded exact = encoded(encode_webp(image), true);
  if (!may_lose) return exact;
  Encoded lossy = encoded(encode_webp(image, {.lossless = false, .quality = quality}), false);
  if (lossy.bytes.size() < exact.bytes.size()) return lossy;
  return exact;
}

/// One image on its way to its format.
class TextureEncoder {
 public:
  TextureEncoder(AssetImage& image, bool is_colour, const LookOptions& options)
      : image_(image), is_colour_(is_colour), options_(options) {}

  /// Replaces the bytes of the image. `warning`: what is to be told of it.
  TextureFigures encode(std::string& warning) {
    TextureFigures told{.name = image_.name, .given_bytes = image_.bytes.size()};
    const bool was_deep = has_sixteen_bits(image_.bytes);
    if (must_be_png()) take(encoded(encode_image(decoded(), ImageFormat::Png), true));
    if (const std::optional<Encoded> other = in_format(warning)) {
      told.exact = other->bytes.size() >= image_.bytes.size() || other->exact;
      if (other->bytes.size() < image_.bytes.size()) take(*other);
    }
    told.kind = image_kind(image_.bytes).name();
    told.bytes = image_.bytes.size();
    if (was_deep && !has_sixteen_bits(image_.bytes))
      warning = image_.name + ": 16 bits a channel become 8, which is all that " + told.kind +
                " images have";
    return told;
  }

 private:
  Image decoded() const {
    return decode_image({image_.bytes.begin(), image_.bytes.end()}, image_.name);
  }

  void take(const Encoded& other) { image_.bytes = other.bytes; }

  /// glTF without its extension has no WebP.
  bool must_be_png() const {
    const ImageKind kind = image_kind(image_.bytes);
    return (kind.is_webp() && !is_webp(options_.textures)) ||
           (kind.is_jpeg() && options_.textures == TextureFormat::Png);
  }

  std::optional<Encoded> in_format(std::string& warning) const {
    const ImageKind kind = image_kind(image_.bytes);
    if (options_.textures == TextureFormat::Jpeg && is_colour_ && !kind.is_jpeg())
      return as_jpeg(decoded());
    if (!is_webp(options_.textures) || kind.is_webp()) return std::nullopt;
    const Image image = decoded();
    if (std::max(image.width, image.height) <= most_webp_side)
      return as_webp(image, is_colour_ && options_.textures == TextureFormat::Webp,
                     options_.webp_quality);
    warning = image_.name + ": stays " + kind.name() + ", for WebP has at most " +
              std::to_string(most_webp_side) + " texels a side";
    return std::nullopt;
  }

  AssetImage& image_;
  bool is_colour_;
  const LookOptions& options_;
};

std::string megabytes(std::size_t bytes) {
  return short_number(static_cast<double>(bytes) / 1e6) + " MB";
}

}  // namespace

const char* word_of(TextureFormat format) {
  switch (format) {
    case TextureFormat::Given:
      return "given";
    case TextureFormat::Png:
      return "png";
    case TextureFormat::Jpeg:
      return "jpeg";
    case TextureFormat::Webp:
      return "webp";
    case TextureFormat::WebpLossless:
      return "webp-lossless";
  }
  return "";
}

std::string words_of(const std::vector<TextureFigures>& textures) {
  std::size_t before = 0, after = 0;
  std::map<std::string, long> kinds;
  for (const TextureFigures& texture : textures) {
    before += texture.given_bytes;
    after += texture.bytes;
    ++kinds[texture.kind + std::string(texture.exact ? "" : " with loss")];
  }
  std::vector<std::string> parts;
  for (const auto& [kind, count] : kinds) parts.push_back(std::to_string(count) + " " + kind);
  return counted(std::ssize(textures), "image") + " of " + megabytes(after) + " in all, " +
         megabytes(before) + " as given: " + joined(parts);
}

void encode_textures(Look& look, const LookOptions& options, int threads) {
  const std::set<int> colours = colours_of(look);
  const std::int64_t count = std::ssize(look.images);
  std::vector<std::string> warnings(look.images.size());
  look.textures.resize(look.images.size());
  parallel_for(count, 1, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const auto at = static_cast<std::size_t>(i);
      TextureEncoder encoder(look.images[at], colours.contains(static_cast<int>(i)), options);
      look.textures[at] = encoder.encode(warnings[at]);
    }
  });
  for (std::string& warning : warnings)
    if (!warning.empty()) look.warnings.push_back(std::move(warning));
}

}  // namespace sphparam
