// texture · factor · colours of the vertices, in linear light; where alpha has a meaning, blended
// faces are drawn over what lies behind them, and masked ones show what lies close behind.

#include "bake/fields/base_colour.h"

#include <algorithm>

#include "bake/fields/attribute_fields.h"
#include "bake/fields/clear_walls.h"
#include "bake/fields/linear_field.h"
#include "bake/fields/material_fields.h"
#include "bake/fields/texture_line.h"
#include "bake/fields/what_is_behind.h"
#include "io/attributes/one_material.h"
#include "io/attributes/source_attributes.h"
#include "texture/read_textures.h"
#include "texture/texture_pyramid.h"

namespace sphparam {
namespace {

constexpr float hardly_any = 1 / 512.0F;  // light that no image of 8 bits shows
constexpr int most_layers = 16;           // behind one another

/// Everything a texture needs, a face.
struct Painter {
  std::vector<SourceTexture> textures;
  std::vector<int> texture_of;  // a face; −1: white; empty: the first texture for all
  SourceCoordinates::Coordinates texcoords;  // null: no image needs them
  TextureFilter filter;
  std::vector<bool> is_opaque;           // a texture: its alpha means nothing; empty: none is
  std::optional<CornerLight> colours;    // of the vertices, that multiply the texture
  std::vector<SourceTexture> opacities;  // a texture: what its alpha is times; empty: 1
  std::vector<AlphaMode> modes;          // a texture; empty: what its alpha means is not said
  float cutoff = 0.5F;                   // of Mask, for all: alphas are scaled to it
  double close_behind = 0;               // how far what is masked out shows it; 0: a hole is one
  std::shared_ptr<const WhatIsBehind> behind;  // what blended faces are drawn over; none: nothing

  const SeamedTexcoords& corners() const {
    static const SeamedTexcoords none;
    return texcoords ? *texcoords : none;
  }

  const SourceTexture& texture(Face f) const {
    static const SourceTexture white;
    if (texture_of.empty()) return textures.front();
    const int texture = texture_of[static_cast<size_t>(f)];
    return texture < 0 ? white : textures[static_cast<size_t>(texture)];
  }

  void paint(std::span<const SurfaceRun> runs, int channels, float* values) const {
    for (const SurfaceRun& run : runs) {
      paint(run, channels, values);
      if (behind && mode(run.face) == AlphaMode::Blend) cover(run, channels, values);
      if (close_behind > 0 && mode(run.face) == AlphaMode::Mask) close(run, channels, values);
      values += channels * run.count;
    }
  }

 private:
  void paint(const SurfaceRun& run, int channels, float* values) const {
    const SourceTexture& its = texture(run.face);
    sample_texture(its, filter, texture_line(run, corners(), its.placement), values, channels);
    if (channels == 4 && opaque(run.face)) set_opaque(run.count, values);
    if (channels == 4 && !opaque(run.face)) fade(run, values);
    if (colours) tint(run, channels, values);
  }

  AlphaMode mode(Face f) const {
    const int texture = texture_of.empty() ? -1 : texture_of[static_cast<size_t>(f)];
    return texture < 0 || modes.empty() ? AlphaMode::Opaque : modes[static_cast<size_t>(texture)];
  }

  /// The colour of one place, and how much it hides.
  std::array<float, 4> seen(const SurfaceRun& place) const {
    std::array<float, 4> colour{};
    const SourceTexture& its = texture(place.face);
    sample_texture(its, filter, texture_line(place, corners(), its.placement), colour.data());
    fade(place, colour.data());
    if (colours) tint(place, 4, colour.data());
    const AlphaMode means = mode(place.face);
    if (means == AlphaMode::Opaque) colour[3] = 1;
    if (means == AlphaMode::Mask) colour[3] = colour[3] < cutoff ? 0 : 1;
    return colour;
  }

  /// Draws blended places over what lies behind them, their own colour where that is nothing.
  void cover(const SurfaceRun& run, int channels, float* values) const {
    for (int i = 0; i < run.count; ++i, values += channels) {
      const std::array<float, 4> own =
          seen({run.face, 1, run.first + i * run.step, run.step, run.below, run.found});
      std::array<float, 3> sum = {own[3] * own[0], own[3] * own[1], own[3] * own[2]};
      float left = 1 - own[3];
      Sight sight = behind->through(run, i);
      for (int layer = 0; left > hardly_any && layer < most_layers; ++layer) {
        const auto next = behind->next(sight);
        if (!next) break;
        const std::array<float, 4> colour = seen(*next);
        for (size_t c = 0; c < 3; ++c) sum[c] += left * colour[3] * colour[c];
        left *= 1 - colour[3];
      }
      if (left >= 1) continue;
      for (size_t c = 0; c < 3; ++c) values[c] = sum[c] / (1 - left);
    }
  }

  bool opaque(Face f) const {
    if (is_opaque.empty() || texture_of.empty()) return false;
    const int texture = texture_of[static_cast<size_t>(f)];
    return texture < 0 || is_opaque[static_cast<size_t>(texture)];
  }

  /// Lets what is masked out show what lies close behind it.
  void close(const SurfaceRun& run, int channels, float* values) const {
    for (int i = 0; channels == 4 && i < run.count; ++i, values += channels) {
      if (values[3] >= cutoff) continue;
      Sight sight = behind->through(run, i);
      const Vector3 from = sight.from;
      for (int layer = 0; layer < most_layers; ++layer) {
        const auto next = behind->next(sight);
        if (!next || (sight.from - from).norm() > close_behind) break;
        const std::array<float, 4> colour = seen(*next);
        if (colour[3] < 0.5F) continue;
        std::copy_n(colour.data(), 3, values);
        values[3] = 1;
        break;
      }
    }
  }

  static void set_opaque(int count, float* values) {
    for (int i = 0; i < count; ++i) values[4 * i + 3] = 1;
  }

  void fade(const SurfaceRun& run, float* values) const {
    if (opacities.empty() || texture_of.empty()) return;
    const int texture = texture_of[static_cast<size_t>(run.face)];
    if (texture < 0 || !opacities[static_cast<size_t>(texture)].image) return;
    const SourceTexture& opacity = opacities[static_cast<size_t>(texture)];
    std::vector<float> texels(4 * static_cast<size_t>(run.count));
    sample_texture(opacity, filter, texture_line(run, corners(), opacity.placement), texels.data());
    for (int i = 0; i < run.count; ++i) values[4 * i + 3] *= texels[4 * static_cast<size_t>(i)];
  }

  /// Alpha of vertices means what that of the texture does.
  void tint(const SurfaceRun& run, int channels, float* values) const {
    std::vector<float> colour(4 * static_cast<size_t>(run.count));
    fill_linear<4>(std::span(&run, 1), colour.data(),
                   [this](Face f, int k, std::array<double, 4>& value) {
                     const Eigen::Index row = colours->row(*triangles, f, k);
                     for (int c = 0; c < 4; ++c)
                       value[static_cast<size_t>(c)] = colours->rows(row, c);
                   });
    const int tinted = channels == 4 && !modes.empty() && !opaque(run.face) ? 4 : 3;
    for (int i = 0; i < run.count; ++i)
      for (int c = 0; c < tinted; ++c)
        values[channels * i + c] *= colour[static_cast<size_t>(4 * i + c)];
  }

 public:
  const Triangles* triangles = nullptr;
};

/// What masks nothing is opaque.
AlphaMode meant(const MaterialChannels& said) {
  const bool masks_nothing = said.alpha_mode == AlphaMode::Mask && !(said.alpha_cutoff > 0);
  return masks_nothing ? AlphaMode::Opaque : said.alpha_mode;
}

bool any_image(const std::vector<SourceTexture>& textures) {
  return std::ranges::any_of(textures,
                             [](const auto& texture) { return texture.image != nullptr; });
}

/// Whether the materials say what alpha means, and their textures are the ones that are looked at.
bool says_alpha(const BakeSource& source) {
  return !source.one_texture_for_all && !source.textures.empty() &&
         source.file().channels.size() == source.textures.size();
}

bool has_alpha(const Painter& painter) {
  const bool of_vertices =
      painter.colours && !painter.modes.empty() && painter.colours->has_alpha();
  for (size_t i = 0; i < painter.textures.size(); ++i) {
    const SourceTexture& texture = painter.textures[i];
    const bool opaque = !painter.is_opaque.empty() && painter.is_opaque[i];
    const bool fades = of_vertices || (i < painter.opacities.size() && painter.opacities[i].image);
    if (!opaque &&
        (texture.factor[3] < 1 || fades || (texture.image && texture.image->has_alpha())))
      return true;
  }
  return false;
}

/// By which faces have one texture or another; null: all have the same.
const Property* material_of(const BakeSource& source) {
  return source.one_texture_for_all ? nullptr : source.file().find_face_property("material");
}

void look_up(const BakeSource& source, const std::vector<SourceTexture>& textures,
             Painter& painter) {
  if (any_image(textures))
    painter.texcoords = source.coordinates->of(source.file(), false, !source.one_texture_for_all);
}

void place_textures(const BakeScene& scene, Painter& painter) {
  const MeshFile& file = scene.source.file();
  painter.textures = scene.source.textures;
  painter.filter = scene.options.filter;
  painter.triangles = &file.mesh.triangles;
  look_up(scene.source, painter.textures, painter);
  if (any_image(painter.textures) && !has_texcoords(file)) {
    const bool own = !scene.source.one_texture_for_all;
    throw FieldError(
        std::string("basecolor: the mesh has no texture coordinates, so its texture has no place") +
        (own ? leaves_images_out : ""));
  }
  if (const Property* material = material_of(scene.source)) {
    painter.texture_of.assign(material->values.begin(), material->values.end());
  }
}

/// All become one material: alphas are such that its cutoff means what theirs do.
void set_alpha(const BakeScene& scene, Painter& painter) {
  const MeshFile& file = scene.source.file();
  const OneMaterial one = one_material(file);
  const bool blends = one.alpha_mode == AlphaMode::Blend;
  painter.cutoff = static_cast<float>(one.alpha_cutoff);
  for (size_t i = 0; i < file.channels.size(); ++i) {
    const AlphaMode mode = meant(file.channels[i]);
    painter.is_opaque.push_back(mode == AlphaMode::Opaque || (mode == AlphaMode::Blend && !blends));
    painter.modes.push_back(mode);
    if (mode == AlphaMode::Mask)
      painter.textures[i].factor[3] *=
          static_cast<float>(one.alpha_cutoff / file.channels[i].alpha_cutoff);
  }
  const auto any = [&](AlphaMode mode) { return std::ranges::count(painter.modes, mode) > 0; };
  if (any(AlphaMode::Mask)) painter.close_behind = 2 * scene.calm_beyond;
  if (!blends && (any(AlphaMode::Blend) || painter.close_behind > 0))
    painter.behind = std::make_shared<const WhatIsBehind>(scene);
  painter.opacities =
      TextureReader(file, TexelKind::Number, scene.threads).read(&MaterialChannels::opacity);
  look_up(scene.source, painter.opacities, painter);
}

SurfaceField field_of(std::shared_ptr<const Painter> painter, const MeshFile& file) {
  SurfaceField field{.name = "basecolor",
                     .channels = has_alpha(*painter) ? 4 : 3,
                     .kind = FieldKind::Colour,
                     .about = "the source's texture"};
  field.texts = texts_of_material(file);
  field.evaluate_runs = [painter = std::move(painter), channels = field.channels](
                            std::span<const SurfaceRun> runs, float* values) {
    painter->paint(runs, channels, values);
  };
  return field;
}

SurfaceField colour_field(const BakeScene& scene) {
  const MeshFile& file = scene.source.file();
  const std::vector<SourceTexture>& textures = scene.source.textures;
  // In glTF colours of vertices multiply what the material says; elsewhere they stand for it.
  const bool tints = file.format.starts_with("glTF") && !textures.empty();
  if (!any_image(textures) && !tints && linear_colours(file)) {
    SurfaceField field = make_opaque_vertex_colour(scene);
    field.name = "basecolor";
    return field;
  }
  if (textures.empty())
    throw NoColoursError("basecolor: the mesh has no texture and no colours at its vertices");
  auto painter = std::make_shared<Painter>();
  place_textures(scene, *painter);
  if (says_alpha(scene.source)) set_alpha(scene, *painter);
  if (tints) painter->colours = corner_light(file);
  return field_of(painter, file);
}

}  // namespace

SurfaceField make_base_colour(const BakeScene& scene, const std::string&) {
  SurfaceField field = colour_field(scene);
  return scene.walls && scene.clear_walls ? with_clear_walls(std::move(field)) : field;
}

}  // namespace sphparam
