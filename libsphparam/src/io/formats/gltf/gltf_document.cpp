#include "io/formats/gltf/gltf_document.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "io/formats/gltf/gltf_files.h"
#include "io/formats/gltf/gltf_json.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_file.h"

// The only file that knows tinygltf, and that as a stranger: the container and the JSON are checked
// first, it gets files through callbacks that ignore the paths it makes, images stay undecoded, and
// unread where they are in files (what it asks for after the last buffer), its exceptions end here,
// and its model is copied into plain data. A primitive it dropped without a word is found by
// counting.

#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace sphparam {
namespace {

constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

struct Container {
  std::string_view json = {};
  std::uint64_t json_offset = 0;
  bool is_binary = false;
  bool has_binary_chunk = false;
  std::string_view whole = {};  // without what follows its end
};

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// The chunk at `at`: its kind, its bytes.
std::pair<std::uint32_t, std::string_view> chunk_at(std::string_view whole, std::size_t at,
                                                    const std::string& name) {
  const auto fail = [&](const std::string& what) { throw ReadError::at_byte(name, at, what); };
  if (whole.size() - at < kChunkHeaderBytes) fail("the file ends within the header of a chunk");
  const std::uint32_t length = word_at(whole, at), kind = word_at(whole, at + 4);
  if (length > whole.size() - at - kChunkHeaderBytes)
    fail("chunk of " + std::to_string(length) + " bytes runs past the end of the file");
  if (length % 4 != 0) fail("the length of a chunk is no multiple of 4");
  return {kind, whole.substr(at + kChunkHeaderBytes, length)};
}

/// Checks the twelve bytes of the header and the headers of all chunks.
Container open_binary(std::string_view bytes, const std::string& name, GltfDocument& document) {
  if (bytes.size() < kHeaderBytes) throw ReadError(name, "is too short for a binary glTF");
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max())
    throw ReadError(name, "is larger than a binary glTF can be (4 GiB)");
  const std::uint32_t version = word_at(bytes, 4), length = word_at(bytes, 8);
  if (version != 2)
    throw ReadError::at_byte(
        name, 4,
        "is binary glTF " + std::to_string(version) + ", which is not supported; version 2 is");
  if (length > bytes.size())
    throw ReadError::at_byte(name, 8,
                             "the header says " + std::to_string(length) + " bytes, the file has " +
                                 std::to_string(bytes.size()));
  if (length < bytes.size()) document.notes.push_back("data after the end of the GLB ignored");
  if (length < kHeaderBytes) throw ReadError::at_byte(name, 8, "the length of the file is wrong");

  Container container{.is_binary = true, .whole = bytes.substr(0, length)};
  const auto [kind, json] = chunk_at(container.whole, kHeaderBytes, name);
  if (kind != kJsonChunk)
    throw ReadError::at_byte(name, kHeaderBytes, "the first chunk is no JSON");
  container.json = json;
  container.json_offset = kHeaderBytes + kChunkHeaderBytes;
  for (std::size_t at = container.json_offset + json.size(); at < length;) {
    const auto [next_kind, chunk] = chunk_at(container.whole, at, name);
    container.has_binary_chunk |= next_kind == kBinaryChunk;
    at += kChunkHeaderBytes + chunk.size();
  }
  return container;
}

Container open(std::string_view bytes, const std::string& name, GltfDocument& document) {
  if (bytes.starts_with("glTF")) return open_binary(bytes, name, document);
  if (bytes.size() > std::numeric_limits<std::int32_t>::max())
    throw ReadError(name, "is too large for a glTF");
  return {.json = bytes, .whole = bytes};
}

/// Hands tinygltf the files of the buffers, in their order, and nothing else.
struct BufferFiles {
  std::vector<std::string> uris;
  std::optional<std::filesystem::path> folder;
  std::uint64_t bytes_left = 0;
  std::size_t next = 0;
  std::string failure = {};

  static bool exists(const std::string&, void* self) {
    const auto& files = *static_cast<BufferFiles*>(self);
    return files.next < files.uris.size();
  }
  static std::string same_path(const std::string& path, void*) { return path; }

  static bool read(std::vector<unsigned char>* bytes, std::string*, const std::string&,
                   void* self) {
    auto& files = *static_cast<BufferFiles*>(self);
    if (files.next == files.uris.size()) return false;
    const std::string& uri = files.uris[files.next++];
    try {
      if (!files.folder) throw std::runtime_error("only a glTF read from a file may name files");
      *bytes = read_below(*files.folder, path_of_uri(uri), files.bytes_left);
      files.bytes_left -= bytes->size();
      return true;
    } catch (const std::runtime_error& error) {
      files.failure =
          std::string("buffer ") + sphparam::quoted(uri) + " cannot be read: " + error.what();
      return false;
    }
  }
  static bool write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  }
};

/// The bytes of a data URI, undecoded. Of an image in a buffer view nothing may be touched here:
/// tinygltf has not asked whether the view lies in its buffer.
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + std::max(size, 0));
  return true;
}

tinygltf::Model parse(const Container& container, BufferFiles& files, const std::string& name) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, nullptr);
  loader.SetFsCallbacks(
      {BufferFiles::exists, BufferFiles::same_path, BufferFiles::read, BufferFiles::write, &files});
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned int>(container.whole.size());
  bool loaded = false;
  try {
    loaded = container.is_binary
                 ? loader.LoadBinaryFromMemory(
                       &model, &error, &warning,
                       reinterpret_cast<const unsigned char*>(container.whole.data()), size, "")
                 : loader.LoadASCIIFromString(&model, &error, &warning, container.whole.data(),
                                              size, "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& unexpected) {
    error = unexpected.what();
  }
  if (!files.failure.empty()) throw ReadError(name, files.failure);
  constexpr std::size_t kShown = 200;
  if (!loaded)
    throw ReadError(name, "cannot be read as glTF: " + one_line(error.substr(0, kShown)));
  return model;
}

GltfDocument::Accessor plain(const tinygltf::Accessor& accessor) {
  GltfDocument::Accessor result{.view = accessor.bufferView,
                                .offset = accessor.byteOffset,
                                .count = accessor.count,
                                .component_type = accessor.componentType,
                                .normalised = accessor.normalized,
                                .sparse = std::nullopt};
  switch (accessor.type) {
    case TINYGLTF_TYPE_SCALAR:
      result.components = 1;
      break;
    case TINYGLTF_TYPE_VEC2:
    case TINYGLTF_TYPE_VEC3:
    case TINYGLTF_TYPE_VEC4:
      result.components = accessor.type;  // which is 2, 3, 4
      break;
    default:
      break;
  }
  if (!accessor.sparse.isSparse) return result;
  const auto& sparse = accessor.sparse;
  result.sparse = GltfDocument::Sparse{.count = sparse.count,
                                       .index_view = sparse.indices.bufferView,
                                       .index_type = sparse.indices.componentType,
                                       .value_view = sparse.values.bufferView,
                                       .index_offset = sparse.indices.byteOffset,
                                       .value_offset = sparse.values.byteOffset};
  return result;
}

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
  if (info.texCoord != 0) colour.problem = "it uses other texture coordinates than the first";
  if (info.extensions.count("KHR_texture_transform"))
    colour.problem = "its texture coordinates are transformed, which is not supported";
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

void note_losses(const tinygltf::Model& model, GltfDocument& document) {
  std::vector<std::string> words;
  const auto add = [&](std::size_t count, const char* thing) {
    if (count > 0) words.push_back(counted(static_cast<long>(count), thing));
  };
  add(model.animations.size(), "animation");
  add(model.cameras.size(), "camera");
  add(model.lights.size(), "light");
  if (!words.empty()) add_loss(document.notes, enumerated(words));
}

GltfDocument::Node plain(const tinygltf::Node& node) {
  return {.mesh = node.mesh,
          .skinned = node.skin >= 0,
          .children = node.children,
          .matrix = node.matrix,
          .translation = node.translation,
          .rotation = node.rotation,
          .scale = node.scale};
}

void copy_model(tinygltf::Model& model, const std::string& name, GltfDocument& document) {
  for (tinygltf::Buffer& buffer : model.buffers) document.buffers.push_back(std::move(buffer.data));
  for (const tinygltf::BufferView& view : model.bufferViews)
    document.views.push_back({view.buffer, view.byteOffset, view.byteLength, view.byteStride});
  for (const tinygltf::Accessor& accessor : model.accessors)
    document.accessors.push_back(plain(accessor));
  for (const tinygltf::Mesh& mesh : model.meshes) {
    document.meshes.emplace_back();
    for (const tinygltf::Primitive& primitive : mesh.primitives)
      document.meshes.back().push_back({primitive.mode, primitive.indices, primitive.material,
                                        static_cast<int>(primitive.targets.size()),
                                        primitive.attributes});
  }
  for (const tinygltf::Node& node : model.nodes) document.nodes.push_back(plain(node));
  for (const tinygltf::Scene& scene : model.scenes) document.scenes.push_back(scene.nodes);
  document.default_scene = model.defaultScene;
  Images images(model, document, name);
  for (const tinygltf::Material& material : model.materials)
    document.materials.push_back({one_line(material.name), base_colour(model, material),
                                  base_colour_of(model, material, images), others_of(material)});
  note_losses(model, document);
}

}  // namespace

GltfDocument load_gltf(std::string_view bytes, const std::string& name,
                       const std::optional<std::filesystem::path>& folder,
                       const ReadOptions& options) {
  GltfDocument document;
  const Container container = open(bytes, name, document);
  GltfSummary summary = check_gltf_json(container.json, container.json_offset,
                                        container.has_binary_chunk, name, options);
  BufferFiles files{std::move(summary.external_buffers), folder, options.max_file_bytes};
  tinygltf::Model model = parse(container, files, name);
  std::int64_t primitives = 0;
  for (const tinygltf::Mesh& mesh : model.meshes)
    primitives += static_cast<std::int64_t>(mesh.primitives.size());
  if (primitives != summary.primitives)
    throw ReadError(name, "a mesh has a primitive without attributes");
  copy_model(model, name, document);
  for (GltfDocument::Material& material : document.materials) {
    BaseColour& colour = material.base_colour;
    if (colour.path.empty()) continue;
    if (folder)
      colour.folder = folder->string();
    else
      colour.problem = "only a glTF read from a file may name files";
  }
  return document;
}

}  // namespace sphparam
