// Texture coordinates are linear on a face, so that along a run they take equal steps, and what a
// texel covers of the texture is the same for all of the run.

#include "bake/fields/base_colour.h"

#include <algorithm>

#include "bake/fields/attribute_fields.h"
#include "io/attributes/source_attributes.h"
#include "texture/texture_pyramid.h"

namespace sphparam {
namespace {

/// Everything a texture needs, a face.
struct Painter {
  std::vector<SourceTexture> textures;
  std::vector<int> texture_of;  // a face; −1: white; empty: the first texture for all
  CornerTexcoords corners;
  TextureFilter filter;

  const SourceTexture& texture(Face f) const {
    static const SourceTexture white;
    if (texture_of.empty()) return textures.front();
    const int texture = texture_of[static_cast<size_t>(f)];
    return texture < 0 ? white : textures[static_cast<size_t>(texture)];
  }

  TextureLine line(const SurfaceRun& run) const {
    TextureLine line{{0, 1}, {0, 0}, {0, 0}, run.count};
    if (corners.rows() == 0) return line;
    for (int k = 0; k < 3; ++k) {
      const double s = corners(3 * run.face + k, 0), t = corners(3 * run.face + k, 1);
      line.first[0] += run.first[k] * s;
      line.first[1] -= run.first[k] * t;
      line.step[0] += run.step[k] * s;
      line.step[1] -= run.step[k] * t;
      line.below[0] += run.below[k] * s;
      line.below[1] -= run.below[k] * t;
    }
    return line;
  }

  void paint(std::span<const SurfaceRun> runs, int channels, float* values) const {
    for (const SurfaceRun& run : runs) {
      sample_texture(texture(run.face), filter, line(run), values, channels);
      values += channels * run.count;
    }
  }
};

bool any_image(const std::vector<SourceTexture>& textures) {
  return std::ranges::any_of(textures,
                             [](const auto& texture) { return texture.image != nullptr; });
}

}  // namespace

SurfaceField make_base_colour(const BakeScene& scene, const std::string& argument) {
  const MeshFile& file = scene.source.file();
  const std::vector<SourceTexture>& textures = scene.source.textures;
  if (!any_image(textures) && linear_colours(file)) {
    SurfaceField field = make_vertex_colour(scene, argument);
    field.name = "basecolor";
    return field;
  }
  if (textures.empty()) {
    throw NoColoursError("basecolor: the mesh has no texture and no colours at its vertices");
  }
  auto painter = std::make_shared<Painter>();
  if (auto corners = texcoords_of(file)) {
    painter->corners = std::move(*corners);
  } else if (any_image(textures)) {
    throw FieldError("basecolor: the mesh has no texture coordinates, so its texture has no place");
  }
  painter->textures = textures;
  painter->filter = scene.options.filter;
  if (const Property* material = file.find_face_property("material");
      material && !scene.source.one_texture_for_all) {
    painter->texture_of.assign(material->values.begin(), material->values.end());
  }
  const bool alpha = std::ranges::any_of(
      textures, [](const auto& t) { return t.factor[3] < 1 || (t.image && t.image->has_alpha()); });
  SurfaceField field{.name = "basecolor",
                     .channels = alpha ? 4 : 3,
                     .kind = FieldKind::Colour,
                     .about = "the source's texture"};
  field.evaluate_runs = [painter, channels = field.channels](std::span<const SurfaceRun> runs,
                                                             float* values) {
    painter->paint(runs, channels, values);
  };
  return field;
}

}  // namespace sphparam
