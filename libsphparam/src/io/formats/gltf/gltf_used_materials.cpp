#include "io/formats/gltf/gltf_used_materials.h"

#include <algorithm>
#include <utility>

#include "io/attributes/appearance.h"
#include "io/attributes/left_out_image.h"
#include "io/attributes/material_comments.h"
#include "number_text.h"
#include "sphparam/io/losses.h"

namespace sphparam {
namespace {

bool any_normal_map(const std::vector<GltfDocument::Material>& materials) {
  return std::ranges::any_of(materials, [](const GltfDocument::Material& material) {
    return !material.channels.normal.image.empty();
  });
}

}  // namespace

std::string gltf_texcoords(const GltfDocument::TextureTransform& transform) {
  return "TEXCOORD_" + std::to_string(transform.texcoord);
}

GltfUsedMaterials::GltfUsedMaterials(const GltfDocument& document)
    : document_(document), has_normal_maps_(any_normal_map(document.materials)) {}

/// Null: there is none of this number.
const GltfDocument::Material* GltfUsedMaterials::find(int material) const {
  const bool is_one = material >= 0 && material < std::ssize(document_.materials);
  return is_one ? &document_.materials[static_cast<std::size_t>(material)] : nullptr;
}

GltfDocument::TextureTransform GltfUsedMaterials::transform_of(
    const GltfDocument::Primitive& primitive) {
  const GltfDocument::Material* const material = find(primitive.material);
  if (!material) return {};
  const GltfDocument::TextureTransform& transform = material->transform;
  if (primitive.attributes.contains(gltf_texcoords(transform))) return transform;
  if (transform.texcoord != 0) without_texcoords_.insert(primitive.material);
  return {};
}

std::string GltfUsedMaterials::second_texcoords_of(const GltfDocument::Primitive& primitive) {
  const GltfDocument::Material* const material = find(primitive.material);
  if (!material || material->second_texcoord < 0) return "";
  const std::string attribute = gltf_texcoords({.texcoord = material->second_texcoord});
  if (primitive.attributes.contains(attribute)) return attribute;
  without_second_.insert(primitive.material);
  return "";
}

void GltfUsedMaterials::finish(MeshFile& file) {
  std::map<int, int> ids;  // in order of first use
  Property property{"material", ScalarType::Int32, {}};
  for (const int material : material_of_) {
    if (!find(material)) {
      property.values.push_back(-1);
      continue;
    }
    const auto [found, is_new] = ids.try_emplace(material, static_cast<int>(ids.size()));
    if (is_new) add_material(material, file);
    property.values.push_back(found->second);
  }
  used_ = std::ssize(ids);
  if (!ids.empty()) file.set_face_property(std::move(property));
}

void GltfUsedMaterials::add_material(int id, MeshFile& file) {
  const GltfDocument::Material& material = *find(id);
  std::vector<std::string> others = material.others;
  file.materials.push_back(material.name.empty() ? "material " + std::to_string(id)
                                                 : material.name);
  file.base_colours.push_back(material.base_colour);
  file.channels.push_back(material.channels);
  file.channels.back().finish.thickness *= scale_of_.at(id);
  if (without_texcoords_.contains(id)) {
    const std::string why = "its texture coordinates are not there";
    file.base_colours.back().problem = why;
    for (MaterialTexture* texture : file.channels.back().textures()) texture->problem = why;
  }
  if (without_second_.contains(id)) {
    for (MaterialTexture* texture : file.channels.back().textures()) {
      if (!texture->second || texture->image.empty()) continue;
      leave_out_image(*texture, file.channels.back());
      others.push_back("textures whose texture coordinates are not there");
    }
  }
  note_nearest(file, file.materials.size() - 1, material.nearest);
  if (!material.words.empty())
    file.comments.push_back("base colour of " + file.materials.back() + ": " + material.words);
  with_others_ += !others.empty();
  for (const std::string& other : others)
    if (std::ranges::count(others_, other) == 0) others_.push_back(other);
}

void GltfUsedMaterials::tell(std::vector<std::string>& notes) const {
  if (with_others_ > 0)
    add_loss(notes, enumerated(others_) + " of " + std::to_string(with_others_) + " of " +
                        counted(used_, "material"));
}

}  // namespace sphparam
