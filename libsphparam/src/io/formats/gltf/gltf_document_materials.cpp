#include "io/formats/gltf/gltf_document_materials.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "io/formats/gltf/gltf_files.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {
namespace {

/// "texture image.png, factor 1 1 1 1"; empty without a texture.
std::string base_colour(const tinygltf::Model& model, const tinygltf::Material& material) {
  const auto& pbr = material.pbrMetallicRoughness;
  const auto texture = static_cast<std::size_t>(pbr.baseColorTexture.index);
  if (texture >= model.textures.size()) return {};
  const auto source = static_cast<std::size_t>(model.textures[texture].source);
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

/// Where the image of a texture is. Nothing in the model is promised to be there.
void find_image(const tinygltf::Model& model, const tinygltf::TextureInfo& info, Images& images,
                BaseColour& colour) {
  if (info.index < 0) return;
  colour.image = "texture " + std::to_string(info.index);
  const auto index = static_cast<std::size_t>(info.index);
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
  const auto source = static_cast<std::size_t>(texture.source);
  if (source >= model.images.size()) {
    colour.problem = "the texture has no image of a kind that is supported";
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
GltfDocument::TextureTransform transform_of(const tinygltf::TextureInfo& info) {
  GltfDocument::TextureTransform transform{.texcoord = info.texCoord};
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

BaseColour base_colour_of(const tinygltf::Model& model, const tinygltf::Material& material,
                          Images& images) {
  BaseColour colour;
  const auto& pbr = material.pbrMetallicRoughness;
  if (pbr.baseColorFactor.size() == 4)
    std::copy(pbr.baseColorFactor.begin(), pbr.baseColorFactor.end(), colour.factor.begin());
  find_image(model, pbr.baseColorTexture, images, colour);
  return colour;
}

/// What a material says beside its base colour.
std::vector<std::string> others_of(const tinygltf::Material& material) {
  const auto& pbr = material.pbrMetallicRoughness;
  const auto& emission = material.emissiveFactor;
  const bool shines =
      std::any_of(emission.begin(), emission.end(), [](double x) { return x != 0; });
  std::vector<std::string> words;
  const auto add = [&](bool said, const std::string& word) {
    if (said) words.push_back(word);
  };
  add(pbr.metallicRoughnessTexture.index >= 0 || pbr.metallicFactor != 1 ||
          pbr.roughnessFactor != 1,
      "metallic and roughness");
  add(material.normalTexture.index >= 0, "normal texture");
  add(material.occlusionTexture.index >= 0, "occlusion texture");
  add(material.emissiveTexture.index >= 0 || shines, "emission");
  add(!material.alphaMode.empty() && material.alphaMode != "OPAQUE", "alpha mode");
  add(material.doubleSided, "double sides");
  for (const auto& [extension, value] : material.extensions)
    words.push_back(sphparam::quoted(extension));
  return words;
}

}  // namespace

std::vector<GltfDocument::Material> materials_of(const tinygltf::Model& model,
                                                 const GltfDocument& document,
                                                 const std::string& name) {
  Images images(model, document, name);
  std::vector<GltfDocument::Material> materials;
  for (const tinygltf::Material& material : model.materials)
    materials.push_back({one_line(material.name), base_colour(model, material),
                         base_colour_of(model, material, images),
                         transform_of(material.pbrMetallicRoughness.baseColorTexture),
                         others_of(material)});
  return materials;
}

}  // namespace sphparam
