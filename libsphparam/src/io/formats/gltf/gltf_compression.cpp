#include "io/formats/gltf/gltf_compression.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>

#include "io/formats/gltf/draco/draco_decoding.h"
#include "io/formats/gltf/gltf_accessors.h"
#include "io/formats/gltf/meshopt_decoding.h"
#include "sphparam/io/mesh_file.h"

// The extensions are read here from the JSON itself: tinygltf would cut their numbers down to 31
// bits. After decompression a document is as if it had never been compressed, so nothing else
// knows.

namespace sphparam {
namespace {

using Json = nlohmann::json;

constexpr const char* meshopt = "EXT_meshopt_compression";
constexpr const char* draco = "KHR_draco_mesh_compression";

/// Where in the file, for messages.
struct Place {
  const std::string& file;
  std::string what;  // "buffer view 3"

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError(file, what + ": " + message);
  }
};

const Json* member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

const Json* extension(const Json& object, const char* key) {
  const Json* extensions = member(object, "extensions");
  return extensions == nullptr ? nullptr : member(*extensions, key);
}

/// The elements of an array that is a member; none where there is none.
const Json& elements(const Json& object, const char* key) {
  static const Json none = Json::array();
  const Json* found = member(object, key);
  return found != nullptr && found->is_array() ? *found : none;
}

std::uint64_t whole_number(const Json& object, const char* key,
                           std::optional<std::uint64_t> otherwise, const Place& place) {
  const Json* found = member(object, key);
  if (found == nullptr && otherwise) return *otherwise;
  constexpr std::uint64_t widest = std::uint64_t{1} << 53;
  if (found == nullptr || !found->is_number_unsigned() || found->get<std::uint64_t>() > widest)
    place.fail(std::string("its compression has no ") + key + ", or one that is no whole number");
  return found->get<std::uint64_t>();
}

int index(const Json& object, const char* key, const Place& place) {
  const std::uint64_t number = whole_number(object, key, std::nullopt, place);
  if (number > std::numeric_limits<std::int32_t>::max())
    place.fail(std::string(key) + " is too large");
  return static_cast<int>(number);
}

std::string word(const Json& object, const char* key) {
  const Json* found = member(object, key);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

GltfCompression::View view_of(const Json& said, const Place& place) {
  return {.buffer = index(said, "buffer", place),
          .offset = whole_number(said, "byteOffset", 0, place),
          .length = whole_number(said, "byteLength", std::nullopt, place),
          .stride = whole_number(said, "byteStride", std::nullopt, place),
          .count = whole_number(said, "count", std::nullopt, place),
          .mode = word(said, "mode"),
          .filter = word(said, "filter")};
}

GltfCompression::Primitive primitive_of(const Json& said, const Place& place) {
  GltfCompression::Primitive primitive{.view = index(said, "bufferView", place), .attributes = {}};
  const Json* attributes = member(said, "attributes");
  if (attributes == nullptr || !attributes->is_object())
    place.fail("its compression has no attributes");
  for (const auto& [attribute, unused] : attributes->items())
    primitive.attributes[attribute] =
        static_cast<std::uint32_t>(index(*attributes, attribute.c_str(), place));
  return primitive;
}

std::string name_of(int mesh, int primitive) {
  return "mesh " + std::to_string(mesh) + " primitive " + std::to_string(primitive);
}

/// Gives accessors whose numbers are in Draco's bytes a view all the same; true if there were any.
bool fill_absent_views(Json& root, const Json& primitive,
                       const GltfCompression::Primitive& packed) {
  const auto accessors = root.find("accessors");
  if (accessors == root.end() || !accessors->is_array()) return false;
  bool any = false;
  const auto fill = [&](const Json& id) {
    if (!id.is_number_unsigned() || id.get<std::uint64_t>() >= accessors->size()) return;
    Json& accessor = (*accessors)[id.get<std::size_t>()];
    if (!accessor.is_object() || member(accessor, "bufferView") != nullptr) return;
    accessor["bufferView"] = 0;  // any
    any = true;
  };
  if (const Json* indices = member(primitive, "indices")) fill(*indices);
  if (const Json* attributes = member(primitive, "attributes"))
    for (const auto& [attribute, unused] : packed.attributes)
      if (const Json* id = member(*attributes, attribute.c_str())) fill(*id);
  return any;
}

/// Gives bytes to buffers that exist in decoded form only; true if there were any.
bool fill_absent_buffers(Json& root) {
  bool any = false;
  const auto buffers = root.find("buffers");
  if (buffers == root.end() || !buffers->is_array()) return false;
  for (Json& buffer : *buffers) {
    if (extension(buffer, meshopt) == nullptr || member(buffer, "uri") != nullptr) continue;
    buffer["uri"] = "data:application/octet-stream;base64,AAAA";
    buffer["byteLength"] = 3;
    any = true;
  }
  return any;
}

std::span<const unsigned char> bytes_of(const GltfDocument& document, int buffer,
                                        std::uint64_t offset, std::uint64_t length,
                                        const Place& place) {
  if (buffer < 0 || buffer >= static_cast<int>(document.buffers.size()))
    place.fail("its compressed bytes are in a buffer that is not there");
  const auto& bytes = document.buffers[static_cast<std::size_t>(buffer)];
  if (offset > bytes.size() || length > bytes.size() - offset)
    place.fail("its compressed bytes run past the end of the buffer");
  return std::span(bytes).subspan(offset, length);
}

/// Views may share their bytes, and primitives their views: all that is decoded together is bounded
/// by the bytes of the file. Regular meshes take some bits a dozen triangles.
class Budget {
 public:
  explicit Budget(const GltfDocument& document) {
    constexpr std::uint64_t most_growth = 1024, always_allowed = 1 << 16;
    for (const auto& buffer : document.buffers) left_ += most_growth * buffer.size();
    left_ += always_allowed;
  }

  void spend(std::uint64_t bytes, const Place& place) {
    if (bytes > left_) place.fail("the file's compressed parts ask for more than it can hold");
    left_ -= bytes;
  }

 private:
  std::uint64_t left_ = 0;
};

/// A new view of a new buffer.
int add_view(GltfDocument& document, std::vector<unsigned char> bytes) {
  document.views.push_back({static_cast<int>(document.buffers.size()), 0, bytes.size(), 0});
  document.buffers.push_back(std::move(bytes));
  return static_cast<int>(document.views.size()) - 1;
}

int add_accessor(GltfDocument& document, GltfDocument::Accessor accessor) {
  document.accessors.push_back(accessor);
  return static_cast<int>(document.accessors.size()) - 1;
}

void decompress_view(GltfDocument& document, int id, const GltfCompression::View& packed,
                     Budget& budget, const Place& place) {
  if (id >= static_cast<int>(document.views.size())) place.fail("there is no such view");
  const auto bytes = bytes_of(document, packed.buffer, packed.offset, packed.length, place);
  GltfDocument::View& view = document.views[static_cast<std::size_t>(id)];
  if (view.stride != 0 && view.stride != packed.stride)
    place.fail("its stride is not that of its compressed rows");
  try {
    std::vector<unsigned char> rows =
        decode_meshopt(bytes, packed.count, packed.stride, packed.mode, packed.filter);
    view = {static_cast<int>(document.buffers.size()), 0, rows.size(),
            packed.mode == "ATTRIBUTES" ? packed.stride : 0};
    budget.spend(rows.size(), place);
    document.buffers.push_back(std::move(rows));
  } catch (const ReadError&) {
    throw;
  } catch (const std::runtime_error& error) {
    place.fail(std::string(meshopt) + ": " + error.what());
  }
}

/// What Draco is asked for: each compressed attribute as its accessor describes it.
std::vector<DracoAttribute> wanted_attributes(const GltfDocument& document,
                                              const GltfDocument::Primitive& primitive,
                                              const GltfCompression::Primitive& packed,
                                              const Place& place) {
  std::vector<DracoAttribute> wanted;
  for (const auto& [attribute, id] : packed.attributes) {
    const auto found = primitive.attributes.find(attribute);
    if (found == primitive.attributes.end() || found->second < 0 ||
        found->second >= static_cast<int>(document.accessors.size()))
      place.fail("its compressed attribute " + attribute + " has no accessor");
    const auto& accessor = document.accessors[static_cast<std::size_t>(found->second)];
    if (accessor.components == 0) place.fail("attribute " + attribute + " is of matrices");
    const std::optional<ScalarType> type = type_of_component(accessor.component_type);
    if (!type) place.fail("glTF has no component type " + std::to_string(accessor.component_type));
    wanted.push_back({.id = id, .type = *type, .components = accessor.components});
  }
  return wanted;
}

void take_over(GltfDocument& document, GltfDocument::Primitive& primitive,
               const GltfCompression::Primitive& packed, DracoMesh mesh) {
  std::size_t next = 0;
  for (const auto& [attribute, unused] : packed.attributes) {
    int& accessor = primitive.attributes.at(attribute);
    GltfDocument::Accessor own = document.accessors[static_cast<std::size_t>(accessor)];
    own.view = add_view(document, std::move(mesh.attributes[next++].rows));
    own.offset = 0;
    own.count = mesh.points;
    own.sparse.reset();
    accessor = add_accessor(document, own);
  }
  std::vector<unsigned char> corners;
  corners.reserve(mesh.corners.size() * sizeof(std::uint32_t));
  for (const std::uint32_t corner : mesh.corners)
    for (int shift = 0; shift < 32; shift += 8)
      corners.push_back(static_cast<unsigned char>(corner >> shift));
  constexpr int uint32_code = 5125, triangles = 4;
  primitive.indices = add_accessor(document, {.view = add_view(document, std::move(corners)),
                                              .count = mesh.corners.size(),
                                              .component_type = uint32_code,
                                              .components = 1,
                                              .sparse = std::nullopt});
  primitive.mode = triangles;
}

void decompress_primitive(GltfDocument& document, GltfDocument::Primitive& primitive,
                          const GltfCompression::Primitive& packed, Budget& budget,
                          const Place& place) {
  if (packed.view < 0 || packed.view >= static_cast<int>(document.views.size()))
    place.fail("its compressed bytes are in a view that is not there");
  const GltfDocument::View view = document.views[static_cast<std::size_t>(packed.view)];
  const auto bytes = bytes_of(document, view.buffer, view.offset, view.length, place);
  const std::vector<DracoAttribute> wanted = wanted_attributes(document, primitive, packed, place);
  try {
    DracoMesh mesh = decode_draco(bytes, wanted);
    std::uint64_t decoded = mesh.corners.size() * sizeof(std::uint32_t);
    for (const DracoAttribute& attribute : mesh.attributes) decoded += attribute.rows.size();
    budget.spend(decoded, place);
    take_over(document, primitive, packed, std::move(mesh));
  } catch (const ReadError&) {
    throw;
  } catch (const std::runtime_error& error) {
    place.fail(std::string(draco) + ": " + error.what());
  }
}

}  // namespace

GltfCompression compression_of(std::string_view json, const std::string& name) {
  GltfCompression compression;
  Json root = Json::parse(json.begin(), json.end());
  const Json& views = elements(root, "bufferViews");
  for (std::size_t v = 0; v < views.size(); ++v)
    if (const Json* said = extension(views[v], meshopt))
      compression.views[static_cast<int>(v)] =
          view_of(*said, {name, "buffer view " + std::to_string(v)});
  bool changed = fill_absent_buffers(root);
  const Json meshes = elements(root, "meshes");
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const Json& primitives = elements(meshes[m], "primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const std::pair at{static_cast<int>(m), static_cast<int>(p)};
      const Json* said = extension(primitives[p], draco);
      if (said == nullptr) continue;
      compression.primitives[at] = primitive_of(*said, {name, name_of(at.first, at.second)});
      changed |= fill_absent_views(root, primitives[p], compression.primitives[at]);
    }
  }
  if (changed) compression.loadable_json = root.dump();
  return compression;
}

void decompress(GltfDocument& document, const GltfCompression& compression,
                const std::string& name) {
  Budget budget(document);
  for (const auto& [id, packed] : compression.views)
    decompress_view(document, id, packed, budget, {name, "buffer view " + std::to_string(id)});
  for (const auto& [at, packed] : compression.primitives)
    decompress_primitive(
        document,
        document.meshes[static_cast<std::size_t>(at.first)][static_cast<std::size_t>(at.second)],
        packed, budget, {name, name_of(at.first, at.second)});
}

}  // namespace sphparam
