// A texture of numbers gives value = offset + scale · texel, with a texel of 1 where a material has
// no image.

#include "bake/fields/material_fields.h"

#include <algorithm>
#include <memory>

#include "bake/fields/texture_line.h"
#include "io/attributes/appearance.h"
#include "io/attributes/finish_terms.h"
#include "io/attributes/one_material.h"
#include "number_text.h"
#include "texture/read_textures.h"

namespace sphparam {
namespace {

/// What a lookup needs of a mesh: which material and which coordinates a face has.
struct MaterialPlaces {
  std::vector<int> material_of;                            // a face; −1: none
  SourceCoordinates::Coordinates corners, second_corners;  // null where no image lies on them
  TextureFilter filter;

  void place(const BakeSource& source, const std::vector<SourceTexture>& textures) {
    for (const bool second : {false, true})
      if (has_image_on(textures, second))
        (second ? second_corners : corners) = source.coordinates->of(source.file(), second, true);
  }

  const SeamedTexcoords& corners_of(const SourceTexture& texture) const {
    static const SeamedTexcoords none;
    const auto& its = texture.second ? second_corners : corners;
    return its ? *its : none;
  }
};

std::shared_ptr<MaterialPlaces> places_of(const BakeScene& scene) {
  const MeshFile& file = scene.source.file();
  auto places = std::make_shared<MaterialPlaces>();
  places->material_of.assign(static_cast<size_t>(file.mesh.face_count()), -1);
  if (const Property* const material = file.find_face_property("material"))
    std::ranges::transform(material->values, places->material_of.begin(),
                           [](double id) { return static_cast<int>(id); });
  places->filter = scene.options.filter;
  return places;
}

void require_channels(const BakeScene& scene, const std::string& field) {
  const MeshFile& file = scene.source.file();
  if (file.channels.empty())
    throw FieldError(field + ": the file says nothing of materials; those of glTF and .mtl do");
}

void require_texcoords(const BakeScene& scene, const std::string& field,
                       const std::vector<SourceTexture>& textures) {
  if (has_image_on(textures, false) && !has_texcoords(scene.source.file()))
    throw FieldError(field + ": the mesh has no texture coordinates, so its texture has no place" +
                     leaves_images_out);
}

/// One number of the materials.
struct NumberChannel {
  MaterialTexture MaterialChannels::*member;
  const char* name;
  bool towards_one;  // 1 + factor·(texel − 1); else factor·texel
};

constexpr NumberChannel occlusion{&MaterialChannels::occlusion, "occlusion", true};
constexpr NumberChannel roughness{&MaterialChannels::roughness, "roughness", false};
constexpr NumberChannel metallic{&MaterialChannels::metallic, "metallic", false};

class NumberTextures {
 public:
  NumberTextures(const BakeScene& scene, const NumberChannel& channel, TextureReader& reader,
                 MaterialPlaces& places)
      : textures_(reader.read(channel.member)) {
    require_texcoords(scene, channel.name, textures_);
    places.place(scene.source, textures_);
    for (const MaterialChannels& said : scene.source.file().channels)
      add(said.*channel.member, channel.towards_one);
    add(MaterialChannels().*channel.member, channel.towards_one);  // of no material
    textures_.emplace_back();
  }

  /// Writes every `stride`-th number.
  void fill(const MaterialPlaces& places, std::span<const SurfaceRun> runs, int stride,
            float* values) const {
    std::vector<float> texels;
    for (const SurfaceRun& run : runs) {
      const int id = places.material_of[static_cast<size_t>(run.face)];
      const size_t m = id < 0 ? textures_.size() - 1 : static_cast<size_t>(id);
      texels.resize(4 * static_cast<size_t>(run.count));
      sample_texture(textures_[m], places.filter,
                     texture_line(run, places.corners_of(textures_[m]), textures_[m].placement),
                     texels.data());
      for (int i = 0; i < run.count; ++i, values += stride)
        *values = offsets_[m] + scales_[m] * texels[static_cast<size_t>(4 * i + channels_[m])];
    }
  }

 private:
  void add(const MaterialTexture& said, bool towards_one) {
    const auto factor = static_cast<float>(said.factor[0]);
    const size_t m = scales_.size();
    if (m < textures_.size()) textures_[m].factor = {1, 1, 1, 1};
    offsets_.push_back(towards_one ? 1 - factor : 0);
    scales_.push_back(factor);
    channels_.push_back(said.channel);
  }

  std::vector<SourceTexture> textures_;
  std::vector<float> offsets_, scales_;
  std::vector<int> channels_;
};

SurfaceField number_field(const BakeScene& scene, SurfaceField field,
                          std::initializer_list<NumberChannel> wanted) {
  require_channels(scene, field.name);
  TextureReader reader(scene.source.file(), TexelKind::Number, scene.threads);
  const auto channels = std::make_shared<std::vector<NumberTextures>>();
  const std::shared_ptr<MaterialPlaces> places = places_of(scene);
  for (const NumberChannel& channel : wanted)
    channels->emplace_back(scene, channel, reader, *places);
  field.channels = static_cast<int>(wanted.size());
  field.range = std::pair(0.0, 1.0);
  field.eight_bits = true;
  field.evaluate_runs = [channels, places](std::span<const SurfaceRun> runs, float* values) {
    const int stride = static_cast<int>(channels->size());
    for (int c = 0; c < stride; ++c)
      (*channels)[static_cast<size_t>(c)].fill(*places, runs, stride, values + c);
  };
  return field;
}

/// The greatest factor of emitted light, at least 1.
double strength_of(const MeshFile& file) {
  double strength = 1;
  for (const MaterialChannels& said : file.channels)
    for (size_t c = 0; c < 3; ++c) strength = std::max(strength, said.emission.factor[c]);
  return strength;
}

std::vector<SourceTexture> emission_of(const BakeScene& scene, double strength) {
  const MeshFile& file = scene.source.file();
  TextureReader reader(file, TexelKind::Colour, scene.threads);
  std::vector<SourceTexture> textures = reader.read(&MaterialChannels::emission);
  textures.push_back({.factor = {0, 0, 0, 1}});  // of no material
  for (SourceTexture& texture : textures)
    for (size_t c = 0; c < 3; ++c)
      texture.factor[c] = static_cast<float>(static_cast<double>(texture.factor[c]) / strength);
  return textures;
}

}  // namespace

SurfaceField make_orm(const BakeScene& scene, const std::string&) {
  return number_field(scene, {.name = "orm", .about = "occlusion, roughness, metallic"},
                      {occlusion, roughness, metallic});
}

SurfaceField make_roughness(const BakeScene& scene, const std::string&) {
  return number_field(scene, {.name = "roughness", .about = "perceptual roughness"}, {roughness});
}

SurfaceField make_metallic(const BakeScene& scene, const std::string&) {
  return number_field(scene, {.name = "metallic", .about = "0: no metal, 1: metal"}, {metallic});
}

SurfaceField make_material_occlusion(const BakeScene& scene, const std::string&) {
  return number_field(scene, {.name = "occlusion", .about = "occlusion, 1: none"}, {occlusion});
}

SurfaceField make_emissive(const BakeScene& scene, const std::string&) {
  require_channels(scene, "emissive");
  const double strength = strength_of(scene.source.file());
  std::vector<SourceTexture> textures = emission_of(scene, strength);
  require_texcoords(scene, "emissive", textures);
  const std::shared_ptr<MaterialPlaces> places = places_of(scene);
  places->place(scene.source, textures);
  SurfaceField field{
      .name = "emissive", .channels = 3, .kind = FieldKind::Colour, .about = "emitted light"};
  if (strength > 1) {
    field.about += ", divided by " + shortest(strength);
    field.texts.emplace_back(strength_text, shortest(strength));
  }
  field.evaluate_runs = [textures = std::move(textures), places](std::span<const SurfaceRun> runs,
                                                                 float* values) {
    for (const SurfaceRun& run : runs) {
      const int id = places->material_of[static_cast<size_t>(run.face)];
      const SourceTexture& texture = id < 0 ? textures.back() : textures[static_cast<size_t>(id)];
      sample_texture(texture, places->filter,
                     texture_line(run, places->corners_of(texture), texture.placement), values, 3);
      values += 3 * run.count;
    }
  };
  return field;
}

std::vector<std::pair<std::string, std::string>> texts_of_material(const MeshFile& file) {
  const auto any = [&](auto&& says) { return std::ranges::any_of(file.channels, says); };
  const OneMaterial one = one_material(file);
  std::vector<std::pair<std::string, std::string>> texts;
  if (one.alpha_mode == AlphaMode::Blend) texts.emplace_back(alpha_text, "blend");
  if (one.alpha_mode == AlphaMode::Mask)
    texts.emplace_back(alpha_text, "mask " + shortest(one.alpha_cutoff));
  if (any([](const auto& said) { return said.double_sided; })) texts.emplace_back(sides_text, "1");
  if (one.unlit) texts.emplace_back(unlit_text, "1");
  if (const std::string finish = to_text(one.finish); !finish.empty())
    texts.emplace_back(finish_text, finish);
  return texts;
}

}  // namespace sphparam
