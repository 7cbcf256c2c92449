#include "render/own_paint.h"

#include <algorithm>

#include "io/attributes/appearance.h"
#include "io/attributes/shading_normals.h"
#include "io/attributes/source_attributes.h"
#include "mesh/vertex_normals.h"

namespace sphparam {
namespace {

bool any_image(const MeshTextures& textures) {
  return std::ranges::any_of(textures.of_materials,
                             [](const auto& texture) { return texture.image != nullptr; });
}

/// In glTF colours of vertices multiply what the material says; elsewhere they stand for it.
bool colours_tint(const MeshFile& file, const MeshTextures& textures) {
  return file.format.starts_with("glTF") && !textures.of_materials.empty() && !textures.one_for_all;
}

std::vector<Rgb> tints_of(const MeshFile& file) {
  std::vector<Rgb> tints;
  const auto light = corner_light(file);
  for (Face f = 0; light && f < file.mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto row = light->rows.row(light->row(file.mesh.triangles, f, k));
      tints.push_back(to_srgb(row.head<3>().cast<float>().transpose()));
    }
  }
  return tints;
}

TexturePaint texture_paint(const MeshFile& file, const MeshTextures& textures) {
  TexturePaint paint{.texcoords = {}, .textures = textures.of_materials};
  const Property* const material =
      textures.one_for_all ? nullptr : file.find_face_property("material");
  if (auto corners = texcoords_of(file))
    paint.texcoords = seamed(file.mesh.triangles, std::move(*corners), material);
  if (colours_tint(file, textures)) paint.tints = tints_of(file);
  if (material) paint.texture_of.assign(material->values.begin(), material->values.end());
  return paint;
}

VertexPaint colour_paint(const Points& colours) {
  VertexPaint paint;
  for (const auto& colour : colours.rowwise()) {
    paint.colours.push_back(colour.cwiseMax(0.0).cwiseMin(1.0).cast<float>().transpose());
  }
  return paint;
}

std::vector<Rgb> pastels(const Points& normals) {
  std::vector<Rgb> colours;
  for (const auto& normal : normals.rowwise())
    colours.push_back((0.6 + 0.35 * normal.array()).cast<float>().matrix().transpose());
  return colours;
}

}  // namespace

Paint own_paint(const MeshFile& file, const MeshTextures& textures) {
  if (any_image(textures) || colours_tint(file, textures)) return texture_paint(file, textures);
  if (const auto colours = vertex_colours(file)) return colour_paint(*colours);
  if (!textures.of_materials.empty()) return texture_paint(file, textures);
  return direction_paint(file);
}

VertexPaint direction_paint(const MeshFile& file) {
  const Points normals = vertex_normals(file.mesh);
  VertexPaint paint{.colours = pastels(normals)};
  if (const auto corners = corner_shading_normals(file, normals))
    paint.of_corners = pastels(*corners);
  return paint;
}

}  // namespace sphparam
