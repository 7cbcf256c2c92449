// As viewers do: normal and tangent are interpolated and not made unit, the bitangent is w · N × T,
// and x T + y B + z N is made unit.

#include "bake/fields/source_normal.h"

#include <algorithm>
#include <array>

#include "bake/fields/material_fields.h"
#include "bake/fields/texture_line.h"
#include "bake/source_tangents.h"
#include "io/attributes/appearance.h"
#include "rays/flat_normal.h"
#include "texture/read_textures.h"

namespace sphparam {
namespace {

Vector3 corner_normal(const BakeSource& source, Face f, int k) {
  if (source.file().corner_normals) return source.file().corner_normals->row(3 * f + k);
  return source.normals.row(source.mesh().triangles(f, k));
}

/// Where opposite normals cancel, that of the face.
Vector3 normal_at(const BakeSource& source, Face f, const Vector3& weights) {
  Vector3 normal = Vector3::Zero();
  for (int k = 0; k < 3; ++k) normal += weights[k] * corner_normal(source, f, k);
  const double length = normal.norm();
  if (length > 0) return normal / length;
  const auto corner = [&](int k) { return source.mesh().position(source.mesh().triangles(f, k)); };
  const Vector3 flat = flat_normal(corner(0), corner(1), corner(2));
  return flat.isZero(0) ? Vector3::UnitZ() : flat;
}

bool has_normal_map(const MeshFile& file) {
  return std::ranges::any_of(file.channels,
                             [](const auto& said) { return !said.normal.image.empty(); });
}

/// Tangents follow the texture coordinates of the normal map, so each placement has its own.
CornerTexcoords placed(const MeshFile& file, const CornerTexcoords& first,
                       const CornerTexcoords& second) {
  CornerTexcoords result = first;
  const Property* material = file.find_face_property("material");
  for (Eigen::Index corner = 0; material && corner < first.rows(); ++corner) {
    const auto id = static_cast<int>(material->values[static_cast<size_t>(corner / 3)]);
    if (id < 0) continue;
    const MaterialTexture& normal = file.channels[static_cast<size_t>(id)].normal;
    const TexturePlacement& p = normal.placement;
    const CornerTexcoords& corners = normal.second ? second : first;
    for (size_t c = 0; c < 2; ++c)
      result(corner, static_cast<int>(c)) =
          p[c][0] * corners(corner, 0) + p[c][1] * corners(corner, 1) + p[c][2];
  }
  return result;
}

/// What the file says of its tangents counts, however they are to be had: its normal maps were made
/// for them.
void take_own_tangents(const MeshFile& file, SourceTangents& frame) {
  if (!file.corner_tangents) return;
  for (Eigen::Index corner = 0; corner < frame.tangents.rows(); ++corner)
    if (const auto own = file.corner_tangents->row(corner); own[3] != 0)
      frame.tangents.row(corner) = own;
}

}  // namespace

struct SourceNormal::Maps {
  std::vector<SourceTexture> textures;  // a material
  std::vector<double> scales;
  std::vector<double> signs;     // of y: −1 where green points down the image
  std::vector<int> material_of;  // a face
  SourceCoordinates::Coordinates corners, second_corners;
  SourceTangents frame;
};

SourceNormal::SourceNormal(const BakeScene& scene) : scene_(&scene) {
  const MeshFile& file = scene.source.file();
  const Property* material = file.find_face_property("material");
  if (!material || !has_normal_map(file)) return;
  auto maps = std::make_shared<Maps>();
  if (!has_texcoords(file)) {
    throw FieldError(
        std::string(
            "normals: the mesh has no texture coordinates, so its normal map has no place") +
        leaves_images_out);
  }
  maps->corners = scene.source.coordinates->of(file, false, true);
  maps->second_corners = scene.source.coordinates->of(file, true, true);
  maps->textures =
      TextureReader(file, TexelKind::Number, scene.threads).read(&MaterialChannels::normal);
  for (SourceTexture& texture : maps->textures) {
    maps->scales.push_back(static_cast<double>(texture.factor[0]));
    maps->signs.push_back(texture.factor[1] < 0 ? -1 : 1);
    texture.factor = {1, 1, 1, 1};
  }
  maps->material_of.assign(material->values.begin(), material->values.end());
  maps->frame =
      source_tangents(file, scene.source.normals,
                      placed(file, maps->corners->corners, maps->second_corners->corners));
  take_own_tangents(file, maps->frame);
  maps_ = std::move(maps);
}

Vector3 SourceNormal::mapped(const SurfaceSample& sample) const {
  const Face f = sample.point.face;
  const int material = maps_->material_of[static_cast<size_t>(f)];
  const Vector3& weights = sample.point.barycentric;
  if (material < 0 || !maps_->textures[static_cast<size_t>(material)].image)
    return normal_at(scene_->source, f, weights);
  const SourceTexture& texture = maps_->textures[static_cast<size_t>(material)];
  std::array<float, 4> texel;
  sample_texture(
      texture, scene_->options.filter,
      texture_line({f, 1, weights, sample.step, sample.below},
                   *(texture.second ? maps_->second_corners : maps_->corners), texture.placement),
      texel.data());
  Vector3 normal = Vector3::Zero(), tangent = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    normal += weights[k] * maps_->frame.normals.row(3 * f + k);
    tangent += weights[k] * maps_->frame.tangents.row(3 * f + k).head<3>();
  }
  if (tangent.isZero(0)) return normal_at(scene_->source, f, weights);
  const double scale = maps_->scales[static_cast<size_t>(material)];
  const double x = scale * (2 * static_cast<double>(texel[0]) - 1),
               y = maps_->signs[static_cast<size_t>(material)] * scale *
                   (2 * static_cast<double>(texel[1]) - 1),
               z = 2 * static_cast<double>(texel[2]) - 1;
  const Vector3 turned =
      x * tangent + y * maps_->frame.tangents(3 * f, 3) * normal.cross(tangent) + z * normal;
  const double length = turned.norm();
  return length > 0 ? Vector3(turned / length) : normal_at(scene_->source, f, weights);
}

Vector3 SourceNormal::at(const SurfaceSample& sample) const {
  const Vector3 normal =
      maps_ ? mapped(sample)
            : normal_at(scene_->source, sample.point.face, sample.point.barycentric);
  return is_back(sample.found) ? Vector3(-normal) : normal;
}

}  // namespace sphparam
