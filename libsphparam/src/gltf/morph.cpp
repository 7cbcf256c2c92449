#include "sphparam/gltf/morph.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "gltf/export_names.h"
#include "io/attributes/appearance.h"
#include "io/attributes/remarks.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"

namespace sphparam {
namespace {

/// Whether a mesh has something of its own to show.
bool is_dressed(const MeshFile& file) {
  return (has_texcoords(file) && !file.base_colours.empty()) || vertex_colours(file);
}

/// The materials of another look, too; `name`: of the first of them.
void append(Look& look, Look other) {
  const int count = static_cast<int>(look.images.size());
  for (Material& material : other.materials) {
    if (material.normal >= 0) material.normal += count;
    for (int* image : material.frameless_images())
      if (*image >= 0) *image += count;
    look.materials.push_back(std::move(material));
  }
  for (AssetImage& image : other.images) look.images.push_back(std::move(image));
  std::ranges::move(other.textures, std::back_inserter(look.textures));
  for (std::string& warning : other.warnings)  // of an image that both have, once
    if (std::ranges::find(look.warnings, warning) == look.warnings.end())
      look.warnings.push_back(std::move(warning));
}

Look named(Look look, const std::string& name) {
  look.materials.front().name = name;
  look.images.front().name = name;
  return look;
}

/// Of both surfaces, on the one sphere.
Look both_looks(const SurfaceMap& map, ExportOptions options) {
  const bool both = is_dressed(map.to().file());
  options.look.bake_colours |= both;
  Look look = make_look(map.from(), options);
  const std::string name = stem_of(map.from().name()), other = stem_of(map.to().name());
  if (is_dressed(map.from().file())) look = named(std::move(look), name);
  if (!both) return look;
  options.source.clear();
  options.look.variants.clear();
  Look of_other = named(make_look(map.to(), options), other == name ? other + " (2)" : other);
  if (!is_dressed(map.from().file())) std::swap(look, of_other);
  append(look, std::move(of_other));
  return look;
}

OtherShape placed(CarriedShape shape, const Similarity& similarity, const std::string& name) {
  OtherShape result{name, std::move(shape.mesh.positions), std::move(shape.normals)};
  for (Eigen::Index v = 0; v < result.positions.rows(); ++v) {
    result.positions.row(v) = similarity(result.positions.row(v));
    result.normals.row(v) = (similarity.rotation * result.normals.row(v).transpose()).normalized();
  }
  return result;
}

/// Numbers of a row, or of a matrix row by row.
std::string text_of(const auto& rows) {
  std::vector<std::string> numbers;
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Eigen::Index k = 0; k < rows.cols(); ++k) numbers.push_back(shortest(rows(i, k)));
  return joined(numbers, " ");
}

/// What the target's vertices and faces have is in no file, either.
void tell_numbers_left_out(const MappedMesh& target, Asset& asset) {
  const std::vector<std::string> words = numbers_not_shown(target.file());
  if (words.empty()) return;
  add_loss(asset.warnings,
           joined(words, " and ") + " of " + target.name() + ": .ply has room for that");
}

}  // namespace

Asset make_morph(const SurfaceMap& map, Placement placement, ExportOptions options) {
  const Similarity similarity = placement_on(map, placement, options.threads);
  options.shape = ShapeKind::Mesh;
  options.morph = Morph::None;
  options.coarser.clear();
  options.others = {
      placed(carried_shape(map, options.threads), similarity, stem_of(map.to().name()))};
  Asset asset = make_asset(map.from(), both_looks(map, options), options);
  tell_numbers_left_out(map.to(), asset);
  asset.extras.insert(asset.extras.end(), {{"target", map.to().name()},
                                           {"target_scale", shortest(similarity.scale)},
                                           {"target_rotation", text_of(similarity.rotation)},
                                           {"target_shift", text_of(similarity.shift)}});
  return asset;
}

}  // namespace sphparam
