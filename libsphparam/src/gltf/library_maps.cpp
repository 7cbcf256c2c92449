#include "gltf/library_maps.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gltf/images/variant_images.h"
#include "image/image_codec.h"
#include "number_text.h"

namespace sphparam {

namespace {

const AssetImage& image_at(const Look& look, int image) {
  return look.images.at(static_cast<std::size_t>(image));
}

MapStatement as_it_is(const char* keyword, const Look& look, int image) {
  MapStatement statement{keyword, image_at(look, image), {}};
  if (!look.textures.empty()) statement.figures = look.textures.at(static_cast<std::size_t>(image));
  return statement;
}

/// One of its channels, grey.
MapStatement of_channel(const char* keyword, const std::string& name, const Image& image,
                        int channel) {
  Image grey(image.width, image.height, 1);
  const auto step = static_cast<std::size_t>(image.channels);
  const auto first = static_cast<std::size_t>(image.channels < 3 ? 0 : channel);
  for (std::size_t i = 0; i < grey.pixels.size(); ++i)
    grey.pixels[i] = image.pixels[i * step + first];
  MapStatement statement{keyword, as_png(name, grey), {}};
  const std::size_t bytes = statement.image.bytes.size();
  statement.figures = {.name = name, .kind = "png", .given_bytes = bytes, .bytes = bytes};
  return statement;
}

}  // namespace

std::vector<MapStatement> map_statements(const Look& look) {
  const Material& seen = look.materials.front();
  std::vector<MapStatement> statements;
  if (seen.metallic_roughness >= 0) {
    const std::string& bytes = image_at(look, seen.metallic_roughness).bytes;
    const Image image = decode_image({bytes.begin(), bytes.end()}, "orm");
    statements.push_back(of_channel("map_Pr", "roughness", image, 1));
    statements.push_back(of_channel("map_Pm", "metallic", image, 2));
  }
  if (seen.emissive >= 0) statements.push_back(as_it_is("map_Ke", look, seen.emissive));
  if (seen.normal >= 0) statements.push_back(as_it_is("norm", look, seen.normal));
  return statements;
}

std::string library_numbers(const Material& material) {
  std::string lines;
  const Material plain;
  if (material.metallic_roughness >= 0)
    lines += "Pr 1\nPm 1\n";
  else if (material.roughness != plain.roughness || material.metallic != plain.metallic)
    lines += "Pr " + shortest(material.roughness) + "\nPm " + shortest(material.metallic) + "\n";
  if (material.emissive < 0) return lines;
  const std::string strength = " " + shortest(material.emissive_strength);
  return lines + "Ke" + strength + strength + strength + "\n";
}

std::vector<std::string> beyond_library(const Look& look) {
  const Material& seen = look.materials.front();
  const std::array<int, 4> written = {0, seen.metallic_roughness, seen.emissive, seen.normal};
  std::vector<std::string> words;
  for (int i = 0; i < static_cast<int>(look.images.size()); ++i)
    if (std::ranges::count(written, i) == 0) words.push_back("the image " + image_at(look, i).name);
  if (seen.occlusion >= 0 && seen.occlusion == seen.metallic_roughness)
    words.push_back("occlusion of the image " + image_at(look, seen.occlusion).name);
  return words;
}

}  // namespace sphparam
