#include "gltf/images/material_images.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "gltf/images/image_kind.h"
#include "gltf/images/jpeg_head.h"
#include "image/image_codec.h"
#include "io/files/file_bytes.h"
#include "number_text.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"
#include "sphparam/texture/equirectangular_image.h"
#include "srgb_curves.h"
#include "texture/baked_texts.h"

namespace sphparam {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 31;

/// "statue_normal-tangent" ends in "normal-tangent".
bool is_named(const std::string& stem, const std::string& map) {
  if (!stem.ends_with(map)) return false;
  if (stem.size() == map.size()) return true;
  const char before = stem[stem.size() - map.size() - 1];
  return before == '_' || before == '-' || before == '.';
}

std::string find_one(const std::vector<fs::path>& files, const std::string& folder,
                     const std::string& map) {
  std::string found;
  for (const fs::path& file : files) {
    if (!is_named(file.stem().string(), map)) continue;
    if (!found.empty()) {
      throw ReadError(folder, "holds more than one image of '" + map +
                                  "': " + fs::path(found).filename().string() + ", " +
                                  file.filename().string() + ": leave one of them there");
    }
    found = file.string();
  }
  return found;
}

/// Whether glTF holds the bytes as they are.
bool stays(std::string_view bytes, const std::string& path, std::vector<std::string>& warnings) {
  const ImageKind kind = image_kind(bytes);
  if (!kind.is_jpeg()) return *kind.mime != 0;
  const JpegHead head = jpeg_head(bytes);
  if (!head.is_whole)
    throw ImageError(path +
                     ": is cut off, the end of the JPEG is not there: copy or save it again");
  if (!head.found) {  // but libjpeg has read it: it passes stray bytes between segments
    warnings.push_back(display_name(path) +
                       ": becomes PNG, for stray bytes lie between the segments of this JPEG");
    return false;
  }
  if (head.is_common()) return true;
  const bool is_coding = head.channels == 1 || head.channels == 3;
  warnings.push_back(display_name(path) + ": becomes PNG, for glTF has no JPEG of " +
                     (is_coding ? "this coding (SOF" + std::to_string(head.process) + ", " +
                                      counted(head.bits, "bit") + ")"
                      : head.channels == 4 ? "4 channels (CMYK)"
                                           : counted(head.channels, "channel")));
  return false;
}

/// Floats as PNG has them: light as sRGB, unit normals of ours as ½ + ½·n.
void as_integers(GivenImage& given, bool is_colour) {
  const SrgbCurves& curves = SrgbCurves::get();
  const auto channels = static_cast<std::size_t>(given.pixels.channels);
  const std::size_t colours = channels < 3 ? 1 : 3;
  const bool is_signed = baked_text(given.texts, "sphparam:min") == "-1";
  for (std::size_t i = 0; i < given.pixels.pixels.size(); ++i) {
    if (i % channels >= colours) continue;
    float& x = given.pixels.pixels[i];
    x = is_colour ? curves.to_srgb(x) : is_signed ? 0.5F + 0.5F * x : x;
  }
}

}  // namespace

GivenImage read_asset_image(const std::string& path, const std::string& name,
                            std::vector<std::string>& warnings) {
  const FileBytes file(path, most_bytes);
  const std::string_view bytes = file.view();
  if (is_exr(bytes))
    throw ImageError(path + ": glTF has no EXR: save it as .png (`sphparam bake -o NAME.png`)");
  GivenImage given{.asset = {name, {}}, .pixels = {}, .texts = {}};
  given.pixels = decode_image({bytes.begin(), bytes.end()}, path, {}, &given.texts);
  if (has_float_samples(given.texts)) as_integers(given, name == "basecolor" || name == "emissive");
  std::string warning = warning_of_shape(path, given.pixels.width, given.pixels.height);
  if (!warning.empty()) warnings.push_back(std::move(warning));
  if (stays(bytes, path, warnings)) {
    given.asset.bytes = bytes;
  } else {
    const std::vector<char> png = encode_image(given.pixels, ImageFormat::Png);
    given.asset.bytes.assign(png.begin(), png.end());
  }
  return given;
}

std::optional<std::array<float, 3>> uniform_colour(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::vector<float>& pixels = image.pixels;
  if (pixels.empty() || !std::equal(pixels.begin() + image.channels, pixels.end(), pixels.begin()))
    return std::nullopt;
  const auto channel = [&](std::size_t c) { return pixels[channels < 3 ? 0 : c]; };
  return std::array{channel(0), channel(1), channel(2)};
}

AlphaMode alpha_mode_of(const Image& image) {
  if (image.channels % 2 != 0) return AlphaMode::Opaque;
  const auto channels = static_cast<std::size_t>(image.channels);
  bool any_clear = false, any_opaque = false, any_between = false;
  for (std::size_t i = channels - 1; i < image.pixels.size(); i += channels) {
    const float alpha = image.pixels[i];
    any_clear |= alpha == 0;
    any_opaque |= alpha == 1;
    any_between |= alpha > 0 && alpha < 1;
  }
  if (any_between) return AlphaMode::Blend;
  return any_clear && any_opaque ? AlphaMode::Mask : AlphaMode::Opaque;
}

BakedImages find_baked_images(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string extension = extension_of(entry.path());
    if (extension == ".png" || extension == ".jpg" || extension == ".jpeg")
      files.push_back(entry.path());
  }
  if (error) throw ReadError(folder, error.message());
  std::sort(files.begin(), files.end());
  BakedImages images{find_one(files, folder, "basecolor"),
                     find_one(files, folder, "normal-tangent"), find_one(files, folder, "ao"),
                     find_one(files, folder, "orm"), find_one(files, folder, "emissive")};
  if (images.base_colour.empty()) images.base_colour = find_one(files, folder, "vcolor");
  if (images.none()) {
    throw ReadError(
        folder, "holds no basecolor, vcolor, normal-tangent, ao, orm or emissive as .png or .jpg");
  }
  return images;
}

}  // namespace sphparam
