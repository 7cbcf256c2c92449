#include "io/formats/gltf/gltf_document.h"

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

#include "io/formats/gltf/gltf_authorship.h"
#include "io/formats/gltf/gltf_compression.h"
#include "io/formats/gltf/gltf_container.h"
#include "io/formats/gltf/gltf_document_materials.h"
#include "io/formats/gltf/gltf_document_model.h"
#include "io/formats/gltf/gltf_files.h"
#include "io/formats/gltf/gltf_json.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_file.h"

// What starts like this file's name knows tinygltf, and that as a stranger: the container and the
// JSON are checked first, it gets files through callbacks that ignore the paths it makes, images
// stay undecoded, and unread where they are in files (what it asks for after the last buffer), its
// exceptions end here, and its model is copied into plain data. A primitive it dropped without a
// word is found by counting.

namespace sphparam {
namespace {

/// Hands tinygltf the files of the buffers, in their order, and nothing else.
struct BufferFiles {
  std::vector<std::string> uris;
  std::optional<std::filesystem::path> folder;
  std::uint64_t bytes_left = 0;
  std::size_t next = 0;
  std::vector<std::string> read_from = {};
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
      const std::filesystem::path path = path_of_uri(uri);
      *bytes = read_below(*files.folder, path, files.bytes_left);
      files.read_from.push_back((*files.folder / path).string());
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

tinygltf::Model parse(std::string_view whole, bool is_binary, BufferFiles& files,
                      const std::string& name) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, nullptr);
  loader.SetFsCallbacks(
      {BufferFiles::exists, BufferFiles::same_path, BufferFiles::read, BufferFiles::write, &files});
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned int>(whole.size());
  bool loaded = false;
  try {
    loaded = is_binary
                 ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                               reinterpret_cast<const unsigned char*>(whole.data()),
                                               size, "")
                 : loader.LoadASCIIFromString(&model, &error, &warning, whole.data(), size, "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& unexpected) {
    error = unexpected.what();
  }
  if (!files.failure.empty()) throw ReadError(name, files.failure);
  constexpr std::size_t most_shown = 200;
  if (!loaded)
    throw ReadError(name, "cannot be read as glTF: " + one_line(error.substr(0, most_shown)));
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
    case TINYGLTF_TYPE_MAT4:
      result.components = 16;
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

/// Materials that a file offers beside those that it shows.
std::size_t variants_of(const tinygltf::Model& model) {
  const auto found = model.extensions.find("KHR_materials_variants");
  if (found == model.extensions.end() || !found->second.Get("variants").IsArray()) return 0;
  return found->second.Get("variants").ArrayLen();
}

constexpr char visibility[] = "KHR_node_visibility";

bool is_hidden(const tinygltf::Node& node) {
  const auto found = node.extensions.find(visibility);
  if (found == node.extensions.end() || !found->second.IsObject()) return false;
  const tinygltf::Value& visible = found->second.Get("visible");
  return visible.IsBool() && !visible.Get<bool>();
}

/// What nodes say by extensions that are not read. Coarser levels of detail are the same again,
/// lights are told by their number.
std::vector<std::string> unread_of_nodes(const tinygltf::Model& model) {
  std::set<std::string> names;
  for (const tinygltf::Node& node : model.nodes)
    for (const auto& [name, value] : node.extensions) names.insert(sphparam::quoted(name));
  for (const char* read :
       {visibility, "EXT_mesh_gpu_instancing", "MSFT_lod", "KHR_lights_punctual"})
    names.erase(sphparam::quoted(read));
  return {names.begin(), names.end()};
}

void note_losses(const tinygltf::Model& model, const SceneOrigin& origin, GltfDocument& document) {
  std::vector<std::string> words;
  const auto add = [&](std::size_t count, const char* thing) {
    if (count > 0) words.push_back(counted(static_cast<long>(count), thing));
  };
  add(model.animations.size() + static_cast<std::size_t>(origin.animations), "animation");
  add(model.cameras.size(), "camera");
  add(model.lights.size(), "light");
  add(variants_of(model), "variant");
  if (!words.empty()) add_loss(document.notes, enumerated(words));
  const std::vector<std::string> unread = unread_of_nodes(model);
  if (!unread.empty()) add_loss(document.notes, enumerated(unread) + " of nodes");
  if (!origin.has_own_extras) return;
  const std::string metadata = other_metadata(model);
  if (!metadata.empty()) add_loss(document.notes, metadata);
}

/// By EXT_mesh_gpu_instancing.
std::map<std::string, int> instances_of(const tinygltf::Node& node) {
  std::map<std::string, int> instances;
  const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
  if (found == node.extensions.end() || !found->second.IsObject() ||
      !found->second.Get("attributes").IsObject())
    return {};
  const tinygltf::Value& attributes = found->second.Get("attributes");
  for (const std::string& name : attributes.Keys())
    if (attributes.Get(name).IsInt()) instances[name] = attributes.Get(name).GetNumberAsInt();
  return instances;
}

GltfDocument::Node plain(const tinygltf::Node& node) {
  return {.mesh = node.mesh,
          .is_hidden = is_hidden(node),
          .skin = node.skin,
          .instances = instances_of(node),
          .children = node.children,
          .matrix = node.matrix,
          .translation = node.translation,
          .rotation = node.rotation,
          .scale = node.scale,
          .weights = node.weights};
}

void copy_model(tinygltf::Model& model, const std::string& name, const SceneOrigin& origin,
                GltfDocument& document) {
  for (tinygltf::Buffer& buffer : model.buffers) document.buffers.push_back(std::move(buffer.data));
  for (const tinygltf::BufferView& view : model.bufferViews)
    document.views.push_back({view.buffer, view.byteOffset, view.byteLength, view.byteStride});
  for (const tinygltf::Accessor& accessor : model.accessors)
    document.accessors.push_back(plain(accessor));
  for (const tinygltf::Mesh& mesh : model.meshes) {
    document.meshes.emplace_back();
    for (const tinygltf::Primitive& primitive : mesh.primitives)
      document.meshes.back().push_back({primitive.mode, primitive.indices, primitive.material,
                                        primitive.attributes, primitive.targets, mesh.weights});
  }
  for (const tinygltf::Node& node : model.nodes) document.nodes.push_back(plain(node));
  for (const tinygltf::Skin& skin : model.skins)
    document.skins.push_back({skin.joints, skin.inverseBindMatrices});
  for (const tinygltf::Scene& scene : model.scenes) document.scenes.push_back(scene.nodes);
  document.default_scene = model.defaultScene;
  document.materials = materials_of(model, document, name, origin);
  document.author = authorship_of(model);
  if (!origin.has_own_extras) document.author.extras.clear();
  note_losses(model, origin, document);
}

void require_all_primitives(const tinygltf::Model& model, std::int64_t wanted,
                            const std::string& name) {
  std::int64_t primitives = 0;
  for (const tinygltf::Mesh& mesh : model.meshes)
    primitives += static_cast<std::int64_t>(mesh.primitives.size());
  if (primitives != wanted) throw ReadError(name, "a mesh has a primitive without attributes");
}

/// Gives textures that name files the folder of these.
class TexturePlacing {
 public:
  explicit TexturePlacing(const std::optional<std::filesystem::path>& folder) : folder_(folder) {}

  void place(MaterialTexture& texture) {
    if (texture.made_of) texture.made_of = placed(texture.made_of);
    if (texture.path.empty()) return;
    if (folder_)
      texture.folder = folder_->string();
    else
      texture.problem = "only a glTF read from a file may name files";
  }

 private:
  using Parts = std::shared_ptr<const SpecularGlossiness>;

  /// The same for all textures that are made of these parts.
  Parts placed(const Parts& parts) {
    Parts& known = placed_[parts.get()];
    if (known) return known;
    auto copy = std::make_shared<SpecularGlossiness>(*parts);
    place(copy->diffuse);
    place(copy->specular);
    known = std::move(copy);
    return known;
  }

  const std::optional<std::filesystem::path>& folder_;
  std::map<const SpecularGlossiness*, Parts> placed_;
};

}  // namespace

GltfDocument load_gltf(std::string_view bytes, const std::string& name,
                       const std::optional<std::filesystem::path>& folder,
                       const ReadOptions& options, const SceneOrigin& origin) {
  GltfDocument document;
  const std::string padded = with_padded_chunks(bytes, document.notes);
  const GltfContainer container = open_gltf(padded.empty() ? bytes : padded, name, document.notes);
  GltfSummary summary = check_gltf_json(container.json, container.json_offset,
                                        container.has_binary_chunk, name, options);
  BufferFiles files{std::move(summary.external_buffers), folder, options.max_file_bytes};
  GltfCompression compression;
  if (summary.compressed) compression = compression_of(container.json, name);
  const std::string loadable =
      compression.loadable_json.empty() ? "" : with_json(container, compression.loadable_json);
  tinygltf::Model model =
      parse(loadable.empty() ? container.whole : loadable, container.is_binary, files, name);
  document.files = std::move(files.read_from);
  require_all_primitives(model, summary.primitives, name);
  copy_model(model, name, origin, document);
  decompress(document, compression, name);
  TexturePlacing textures(folder);
  for (GltfDocument::Material& material : document.materials) {
    textures.place(material.base_colour);
    for (MaterialTexture* texture : material.channels.textures()) textures.place(*texture);
  }
  return document;
}

}  // namespace sphparam
