#include "io/formats/gltf/gltf_document_materials.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "elementary.h"
#include "io/attributes/finish_terms.h"
#include "io/attributes/left_out_image.h"
#include "io/attributes/specular_glossiness.h"
#include "io/formats/gltf/gltf_files.h"
#include "number_text.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {
namespace {

using Transform = GltfDocument::TextureTransform;

constexpr char specular_glossiness[] = "KHR_materials_pbrSpecularGlossiness";

constexpr auto npos = static_cast<std::size_t>(-1);

/// The number of a texture's image: the one that all programs read, or else that of
/// EXT_texture_webp; beyond those of the file where there is none.
std::size_t image_of(const tinygltf::Texture& texture) {
  if (texture.source >= 0) return static_cast<std::size_t>(texture.source);
  const auto webp = texture.extensions.find("EXT_texture_webp");
  if (webp == texture.extensions.end() || !webp->second.Has("source")) return npos;
  const tinygltf::Value& source = webp->second.Get("source");
  return source.IsInt() ? static_cast<std::size_t>(source.Get<int>()) : npos;
}

/// "texture image.png, factor 1 1 1 1"; empty without a texture.
std::string base_colour(const tinygltf::Model& model, const tinygltf::Material& material) {
  const auto& pbr = material.pbrMetallicRoughness;
  const auto texture = static_cast<std::size_t>(pbr.baseColorTexture.index);
  if (texture >= model.textures.size()) return {};
  const std::size_t source = image_of(model.textures[texture]);
  if (source >= model.images.size()) return {};
  const tinygltf::Image& image = model.images[source];
  std::string text = "texture ";
  if (!image.uri.empty()) {
    text += image.uri;
  } else {
    text += "image " + std::to_string(source) + " of the file";
  }
  text += ", factor";
  for (const double factor : pbr.baseColorFactor) text.append(" ").append(std::to_string(factor));
  return one_line(text);
}

Wrapping wrapping(int code) {
  if (code == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrapping::Clamp;
  return code == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrapping::Mirror : Wrapping::Repeat;
}

/// The images inside the file that materials use. One that several use, or that several images show
/// the same bytes of, is kept once; all together are no larger than what they lie in.
class Images {
 public:
  using Bytes = std::shared_ptr<const std::vector<char>>;

  Images(const tinygltf::Model& model, const GltfDocument& document, const std::string& name)
      : model_(model), document_(document), name_(name) {
    for (const auto& buffer : document.buffers) bytes_left_ += buffer.size();
  }

  /// Empty bytes of an image that is not inside the file.
  Bytes bytes(std::size_t image) {
    const tinygltf::Image& described = model_.images[image];
    if (described.bufferView >= 0) return of_view(image, described.bufferView);
    Bytes& kept = of_uris_[image];
    if (!kept) kept = copy(described.image.data(), described.image.size());
    return kept;
  }

 private:
  static Bytes copy(const unsigned char* first, std::size_t size) {
    return std::make_shared<const std::vector<char>>(first, first + size);
  }

  Bytes of_view(std::size_t image, int id) {
    const auto fail = [&](const std::string& message) {
      throw ReadError(name_, "image " + std::to_string(image) + ": " + message);
    };
    if (id >= static_cast<int>(document_.views.size())) fail("no such buffer view");
    const GltfDocument::View& view = document_.views[static_cast<std::size_t>(id)];
    if (view.buffer < 0 || view.buffer >= static_cast<int>(document_.buffers.size()))
      fail("its view names a buffer that is not there");
    const auto& buffer = document_.buffers[static_cast<std::size_t>(view.buffer)];
    if (view.offset > buffer.size() || view.length > buffer.size() - view.offset)
      fail("its view runs past the end of the buffer");
    Bytes& kept = of_views_[{view.buffer, view.offset, view.length}];
    if (kept) return kept;
    if (view.length > bytes_left_) fail("the images ask for more bytes than the buffers hold");
    bytes_left_ -= view.length;
    return kept = copy(buffer.data() + view.offset, view.length);
  }

  const tinygltf::Model& model_;
  const GltfDocument& document_;
  const std::string& name_;
  std::map<std::size_t, Bytes> of_uris_;
  std::map<std::tuple<int, std::uint64_t, std::uint64_t>, Bytes> of_views_;  // by their ranges
  std::uint64_t bytes_left_ = 0;
};

/// Whether its sampler shows texels as they are.
bool is_nearest(const tinygltf::Model& model, int id) {
  const auto index = static_cast<std::size_t>(id);
  if (index >= model.textures.size()) return false;
  const auto sampler = static_cast<std::size_t>(model.textures[index].sampler);
  return sampler < model.samplers.size() &&
         model.samplers[sampler].magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
}

/// Of a texture without an image that is read.
std::string problem_of_kind(const tinygltf::Texture& texture) {
  for (const auto& [extension, kind] : {std::pair("KHR_texture_basisu", "KTX2"),
                                        {"EXT_texture_avif", "AVIF"},
                                        {"MSFT_texture_dds", "DDS"}})
    if (texture.extensions.contains(extension))
      return std::string("its image is ") + kind +
             ", which is not read: PNG, JPEG and WebP are, as which it can be written anew";
  return "the texture has no image of a kind that is supported";
}

/// Where the image of a texture is. Nothing in the model is promised to be there.
void find_image(const tinygltf::Model& model, int id, Images& images, MaterialTexture& colour) {
  if (id < 0) return;
  colour.image = "texture " + std::to_string(id);
  const auto index = static_cast<std::size_t>(id);
  if (index >= model.textures.size()) {
    colour.problem = "the file has no such texture";
    return;
  }
  const tinygltf::Texture& texture = model.textures[index];
  if (const auto sampler = static_cast<std::size_t>(texture.sampler);
      sampler < model.samplers.size()) {
    colour.wrap_s = wrapping(model.samplers[sampler].wrapS);
    colour.wrap_t = wrapping(model.samplers[sampler].wrapT);
  }
  const std::size_t source = image_of(texture);
  if (source >= model.images.size()) {
    colour.problem = problem_of_kind(texture);
    return;
  }
  const std::string& uri = model.images[source].uri;
  colour.image = uri.empty() ? "image " + std::to_string(source) : one_line(uri);
  if (const Images::Bytes bytes = images.bytes(source); !bytes->empty()) {
    colour.bytes = bytes;
  } else if (!uri.empty()) {
    try {
      colour.path = path_of_uri(uri).string();
    } catch (const std::runtime_error& error) {
      colour.problem = error.what();
    }
  } else {
    colour.problem = "it has no bytes";
  }
}

/// Members of the wrong type are as if they were not there.
template <class Info>
Transform transform_of(const Info& info) {
  Transform transform{.texcoord = info.texCoord};
  const auto found = info.extensions.find("KHR_texture_transform");
  if (found == info.extensions.end()) return transform;
  const tinygltf::Value& said = found->second;
  const auto pair = [&](const char* key, std::array<double, 2>& numbers) {
    const tinygltf::Value& value = said.Get(key);
    if (!value.IsArray() || value.ArrayLen() != 2) return;
    for (int i = 0; i < 2; ++i)
      if (value.Get(i).IsNumber())
        numbers[static_cast<std::size_t>(i)] = value.Get(i).GetNumberAsDouble();
  };
  pair("scale", transform.scale);
  pair("offset", transform.offset);
  if (said.Get("rotation").IsNumber())
    transform.rotation = said.Get("rotation").GetNumberAsDouble();
  if (said.Get("texCoord").IsInt()) transform.texcoord = said.Get("texCoord").GetNumberAsInt();
  return transform;
}

/// (u, v, 1) of vertices → (u, v, 1) of the image.
Eigen::Matrix3d matrix_of(const Transform& t) {
  const double c = elementary::cos(t.rotation), s = elementary::sin(t.rotation);
  Eigen::Matrix3d m;
  m << c * t.scale[0], s * t.scale[1], t.offset[0],  //
      -s * t.scale[0], c * t.scale[1], t.offset[1],  //
      0, 0, 1;
  return m;
}

/// From where the mesh has its texture coordinates, t upwards, to where this image has them.
TexturePlacement placement_from(const Transform& mesh, const Transform& image) {
  if (mesh == image) return {{{1, 0, 0}, {0, 1, 0}}};
  const Eigen::Matrix3d m = matrix_of(image) * matrix_of(mesh).inverse();
  return {{{m(0, 0), -m(0, 1), m(0, 1) + m(0, 2)}, {-m(1, 0), m(1, 1), 1 - m(1, 1) - m(1, 2)}}};
}

/// What a material says, texture by texture. The mesh has two sets of texture coordinates for all:
/// that of the first texture, and the first other one.
class MaterialReader {
 public:
  MaterialReader(const tinygltf::Model& model, const tinygltf::Material& material, Images& images,
                 const SceneOrigin& origin)
      : model_(model), said_(material), images_(images), origin_(origin) {}

  GltfDocument::Material read() {
    result_.name = one_line(said_.name);
    const auto shine = said_.extensions.find(specular_glossiness);
    if (shine != said_.extensions.end() && shine->second.IsObject() && !origin_.specular_glossiness)
      read_specular_glossiness(shine->second);
    else
      read_metallic_roughness();
    MaterialChannels& channels = result_.channels;
    channels.normal.factor[0] = said_.normalTexture.scale;
    channels.occlusion.factor[0] = said_.occlusionTexture.strength;
    read_emission();
    add_texture(said_.normalTexture, channels.normal, "normal");
    add_texture(said_.occlusionTexture, channels.occlusion, "occlusion");
    add_texture(said_.emissiveTexture, channels.emission, "emissive");
    read_modes();
    return std::move(result_);
  }

 private:
  void read_metallic_roughness() {
    const auto& pbr = said_.pbrMetallicRoughness;
    MaterialChannels& channels = result_.channels;
    result_.words = base_colour(model_, said_);
    if (pbr.baseColorFactor.size() == 4)
      std::ranges::copy(pbr.baseColorFactor, result_.base_colour.factor.begin());
    channels.roughness.factor[0] = pbr.roughnessFactor;
    channels.metallic.factor[0] = pbr.metallicFactor;
    channels.roughness.channel = 1;
    channels.metallic.channel = 2;
    add_texture(pbr.baseColorTexture, result_.base_colour, "base colour");
    add_texture(pbr.metallicRoughnessTexture, channels.roughness, "roughness");
    add_texture(pbr.metallicRoughnessTexture, channels.metallic, "metallic");
  }

  /// Base colour, roughness and metallic are made of it, here where it has no images.
  void read_specular_glossiness(const tinygltf::Value& said) {
    SpecularGlossiness parts;
    set_factor(said, "diffuseFactor", 4, parts.diffuse);
    set_factor(said, "specularFactor", 3, parts.specular);
    if (said.Get("glossinessFactor").IsNumber())
      parts.specular.factor[3] = said.Get("glossinessFactor").GetNumberAsDouble();
    add_texture(texture_in(said, "diffuseTexture"), parts.diffuse, "diffuse");
    add_texture(texture_in(said, "specularGlossinessTexture"), parts.specular, "specular");
    const bool both = !parts.diffuse.image.empty() && !parts.specular.image.empty();
    if (both && (parts.diffuse.placement != parts.specular.placement ||
                 parts.diffuse.second != parts.specular.second)) {
      parts.specular.image.clear();
      result_.others.emplace_back("specular textures in another place than diffuse ones");
    }
    rename_nearest(parts);
    const std::string between = both && !parts.specular.image.empty() ? " and " : "";
    MaterialTexture made = parts.diffuse.image.empty() ? parts.specular : parts.diffuse;
    made.image = parts.diffuse.image + between + parts.specular.image;
    made.bytes = nullptr;
    made.path = made.problem = "";
    made.factor = {1, 1, 1, 1};
    made.made_of = std::make_shared<const SpecularGlossiness>(std::move(parts));
    const std::array<MaterialTexture*, 3> all = {&result_.base_colour, &result_.channels.roughness,
                                                 &result_.channels.metallic};
    for (int channel = 0; channel < 3; ++channel) {
      MaterialTexture& one = *all[static_cast<std::size_t>(channel)] = made;
      one.channel = channel;
      if (one.image.empty()) leave_factors(one);
    }
  }

  static void set_factor(const tinygltf::Value& said, const char* key, std::size_t count,
                         MaterialTexture& texture) {
    const std::vector<double> numbers =
        said.Has(key) ? numbers_in(said.Get(key)) : std::vector<double>();
    if (numbers.size() == count) std::ranges::copy(numbers, texture.factor.begin());
  }

  static tinygltf::TextureInfo texture_in(const tinygltf::Value& said, const char* key) {
    tinygltf::TextureInfo info;
    const tinygltf::Value& value = said.Get(key);
    if (!value.IsObject()) return info;
    if (value.Get("index").IsInt()) info.index = value.Get("index").GetNumberAsInt();
    if (value.Get("texCoord").IsInt()) info.texCoord = value.Get("texCoord").GetNumberAsInt();
    const tinygltf::Value& extensions = value.Get("extensions");
    if (extensions.IsObject() && extensions.Has("KHR_texture_transform"))
      info.extensions["KHR_texture_transform"] = extensions.Get("KHR_texture_transform");
    return info;
  }

  template <class Info>
  void add_texture(const Info& info, MaterialTexture& texture, const std::string& what) {
    if (info.index < 0) return;
    const Transform transform = transform_of(info);
    if (!placed_) placed_ = result_.transform = transform;
    const bool second = transform.texcoord != placed_->texcoord;
    if (second && result_.second_texcoord < 0) result_.second_texcoord = transform.texcoord;
    const TexturePlacement placement =
        placement_from(second ? Transform{.texcoord = transform.texcoord} : *placed_, transform);
    const bool has_place =
        std::ranges::all_of(placement[0], [](double x) { return std::isfinite(x); }) &&
        std::ranges::all_of(placement[1], [](double x) { return std::isfinite(x); });
    if (second && transform.texcoord != result_.second_texcoord) {
      result_.others.push_back(what + " textures on a third set of texture coordinates");
      return leave_out_image(texture, result_.channels);
    }
    if (!has_place) {
      result_.others.push_back(what + " textures whose place is no number");
      return leave_out_image(texture, result_.channels);
    }
    texture.placement = placement;
    texture.second = second;
    if (is_nearest(model_, info.index)) result_.nearest.push_back(what);
    find_image(model_, info.index, images_, texture);
  }

  /// Which texels are not filtered, by the names of the textures that are made.
  void rename_nearest(const SpecularGlossiness& parts) {
    const bool diffuse = std::erase(result_.nearest, "diffuse") > 0,
               specular = std::erase(result_.nearest, "specular") > 0;
    if (parts.diffuse.image.empty() ? specular : diffuse) result_.nearest.push_back("base colour");
    if (parts.specular.image.empty() ? diffuse : specular)
      result_.nearest.insert(result_.nearest.end(), {"roughness", "metallic"});
  }

  void read_emission() {
    double strength = 1;
    const auto found = said_.extensions.find("KHR_materials_emissive_strength");
    if (found != said_.extensions.end() && found->second.Get("emissiveStrength").IsNumber())
      strength = std::max(0.0, found->second.Get("emissiveStrength").GetNumberAsDouble());
    for (std::size_t c = 0; c < 3 && said_.emissiveFactor.size() == 3; ++c)
      result_.channels.emission.factor[c] = strength * said_.emissiveFactor[c];
  }

  void read_modes() {
    MaterialChannels& channels = result_.channels;
    channels.alpha_mode = said_.alphaMode == "MASK"    ? AlphaMode::Mask
                          : said_.alphaMode == "BLEND" ? AlphaMode::Blend
                                                       : AlphaMode::Opaque;
    channels.alpha_cutoff = said_.alphaCutoff;
    channels.double_sided = said_.doubleSided;
    for (const auto& [extension, value] : said_.extensions) {
      if (extension == "KHR_materials_unlit")
        channels.unlit = true;
      else if (extension == specular_glossiness) {
        if (origin_.specular_glossiness) result_.others.emplace_back(origin_.specular_glossiness);
      } else if (extension != "KHR_materials_emissive_strength" && !read_finish(extension, value))
        result_.others.push_back(sphparam::quoted(extension));
    }
  }

  /// Whether it is one whose factors are carried. What an image says of its first factors is not
  /// carried, and without it they would be said of all of the surface.
  bool read_finish(const std::string& extension, const tinygltf::Value& said) {
    static const std::set<std::string> of_first_factors = {
        "clearcoatTexture",     "sheenColorTexture",  "transmissionTexture", "specularTexture",
        "specularColorTexture", "iridescenceTexture", "thicknessTexture"};
    bool known = false, by_image = false;
    for (const FinishTerm& term : finish_terms())
      known = known || extension == std::string("KHR_materials_") + term.extension;
    if (!known || !said.IsObject()) return known;
    for (const std::string& key : said.Keys()) {
      if (!key.ends_with("Texture")) continue;
      result_.others.push_back(key);
      by_image = by_image || of_first_factors.contains(key);
    }
    if (by_image) return true;
    for (const FinishTerm& term : finish_terms())
      if (extension == std::string("KHR_materials_") + term.extension && said.Has(term.key))
        set_numbers(term, numbers_in(said.Get(term.key)), result_.channels.finish);
    return true;
  }

  static std::vector<double> numbers_in(const tinygltf::Value& value) {
    std::vector<double> numbers;
    const int count = value.IsArray() ? static_cast<int>(value.ArrayLen()) : 1;
    for (int i = 0; i < count; ++i) {
      const tinygltf::Value& one = value.IsArray() ? value.Get(i) : value;
      if (!one.IsNumber()) return {};
      numbers.push_back(one.GetNumberAsDouble());
    }
    return numbers;
  }

  const tinygltf::Model& model_;
  const tinygltf::Material& said_;
  Images& images_;
  const SceneOrigin& origin_;
  GltfDocument::Material result_;
  std::optional<Transform> placed_;  // of the first texture
};

}  // namespace

std::vector<GltfDocument::Material> materials_of(const tinygltf::Model& model,
                                                 const GltfDocument& document,
                                                 const std::string& name,
                                                 const SceneOrigin& origin) {
  Images images(model, document, name);
  std::vector<GltfDocument::Material> materials;
  for (const tinygltf::Material& material : model.materials)
    materials.push_back(MaterialReader(model, material, images, origin).read());
  return materials;
}

}  // namespace sphparam
