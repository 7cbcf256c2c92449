#include "gltf/material_images.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "gltf/image_kind.h"
#include "image/image_codec.h"
#include "io/files/file_bytes.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"
#include "sphparam/texture/equirectangular_image.h"

namespace sphparam {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 31;

bool is_exr(std::string_view bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

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

}  // namespace

AssetImage read_asset_image(const std::string& path, const std::string& name, ImageTexts& texts,
                            std::vector<std::string>& warnings) {
  const FileBytes file(path, most_bytes);
  const std::string_view bytes = file.view();
  if (is_exr(bytes)) throw ImageError(path + ": glTF holds PNG and JPEG, not EXR: bake to .png");
  const Image image = decode_image({bytes.begin(), bytes.end()}, path, {}, &texts);
  std::string warning = warning_of_shape(path, image.width, image.height);
  if (!warning.empty()) warnings.push_back(std::move(warning));
  if (*image_kind(bytes).mime) return {name, std::string(bytes)};
  const std::vector<char> png = encode_image(image, ImageFormat::Png);
  return {name, {png.begin(), png.end()}};
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
