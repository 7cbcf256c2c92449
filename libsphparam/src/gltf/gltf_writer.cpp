#include "sphparam/gltf/gltf_writer.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "gltf/format/glb_container.h"
#include "gltf/format/packing.h"
#include "gltf/images/image_kind.h"
#include "io/attributes/authorship.h"
#include "io/attributes/finish_terms.h"
#include "io/uri.h"
#include "option_domain.h"
#include "sphparam/version.h"

// Buffers are packed, placed in the one buffer and described by JSON as they come; the container is
// put around both at the end. JSON and container are written directly: glTF libraries lose image
// bytes, cannot say a buffer that is not there (EXT_meshopt_compression's fallback), and copy.

namespace sphparam {
namespace {

using Json = nlohmann::ordered_json;

enum Target { ArrayBuffer = 34962, ElementArrayBuffer = 34963 };
enum Sampler { Linear = 9729, LinearMipmapLinear = 9987, Repeat = 10497, ClampToEdge = 33071 };

const char* type_name(int components) {
  static constexpr const char* names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return names[components - 1];
}

class Builder {
 public:
  Builder(const Asset& asset, const GltfOptions& options)
      : asset_(asset), options_(options), buffer_(options.compress) {
    finest_ = numbers_of_positions(asset.levels.front());
  }

  GltfFiles build() {
    start();
    for (const AssetImage& image : asset_.images) add_image(image);
    for (const Material& material : asset_.materials) add_material(material);
    add_node(asset_.levels.front());
    if (!asset_.coarse_levels_have_normal_maps && asset_.levels.size() > 1) add_coarse_materials();
    for (std::size_t i = 1; i < asset_.levels.size(); ++i) add_node(asset_.levels[i]);
    add_levels_of_detail();
    add_variants();
    add_animation();
    return finish();
  }

 private:
  void start() {
    Json extras = Json::object();
    for (const auto& [key, value] : asset_.extras) extras[key] = value;
    root_["asset"] = {{"version", "2.0"}, {"generator", std::string("sphparam ") + version}};
    if (!asset_.copyright.empty()) root_["asset"]["copyright"] = asset_.copyright;
    Json all = Json::parse(plain_extras(asset_.source_extras), nullptr, false);
    if (!all.is_object()) all = Json::object();
    if (!extras.empty()) all["sphparam"] = std::move(extras);
    if (!all.empty()) root_["asset"]["extras"] = std::move(all);
    root_["scene"] = 0;
  }

  void use(const std::string& extension, bool required = false) {
    used_.insert(extension);
    if (required) required_.insert(extension);
  }

  // --- images and materials ---

  void add_image(const AssetImage& image) {
    const ImageKind kind = image_kind(image.bytes);
    Json entry{{"name", image.name}};
    // Beside compressed views nothing else may use the buffer, and validators call it unused.
    if (options_.container == GltfContainer::Binary || options_.compress) {
      entry["mimeType"] = kind.mime;
      entry["bufferView"] = add_view(buffer_.place(image.bytes));
    } else if (options_.container == GltfContainer::Embedded) {
      entry["uri"] = data_uri(kind.mime, image.bytes);
    } else {
      const std::string name = options_.stem + "_" + image.name + kind.extension;
      entry["uri"] = uri_of_file(name);
      files_.emplace_back(name, image.bytes);
    }
    lists_.textures.push_back(texture_of(kind, lists_.images.size()));
    lists_.images.push_back(std::move(entry));
  }

  Json texture_of(const ImageKind& kind, std::size_t image) {
    if (!kind.is_webp()) return {{"sampler", 0}, {"source", image}};
    use("EXT_texture_webp", true);  // there is no other image
    return {{"sampler", 0}, {"extensions", {{"EXT_texture_webp", {{"source", image}}}}}};
  }

  /// 0 and 1 as whole ones.
  static Json number(double factor) {
    return factor == 0 || factor == 1 ? Json(static_cast<int>(factor)) : Json(factor);
  }

  void add_material(const Material& material) {
    const double metallic = material.unlit ? 0 : material.metallic,
                 roughness = material.unlit ? 1 : material.roughness;
    Json pbr{{"metallicFactor", number(metallic)}, {"roughnessFactor", number(roughness)}};
    if (material.base_colour >= 0) pbr["baseColorTexture"] = {{"index", material.base_colour}};
    if (material.metallic_roughness >= 0 && !material.unlit) {
      pbr["metallicFactor"] = pbr["roughnessFactor"] = 1;
      pbr["metallicRoughnessTexture"] = {{"index", material.metallic_roughness}};
    }
    Json entry{{"name", material.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    if (material.unlit) {
      entry["extensions"]["KHR_materials_unlit"] = Json::object();
      use("KHR_materials_unlit");
    } else {
      if (material.normal >= 0) entry["normalTexture"] = {{"index", material.normal}};
      if (material.occlusion >= 0) entry["occlusionTexture"] = {{"index", material.occlusion}};
      if (material.emissive >= 0) add_emission(material, entry);
      add_finish(material.finish, entry);
    }
    if (material.alpha_mode == AlphaMode::Blend) entry["alphaMode"] = "BLEND";
    if (material.alpha_mode == AlphaMode::Mask) {
      entry["alphaMode"] = "MASK";
      entry["alphaCutoff"] = material.alpha_cutoff;
    }
    // A volume has an inside, which nobody looks at from there.
    if (material.double_sided && !entry["extensions"].contains("KHR_materials_volume"))
      entry["doubleSided"] = true;
    if (entry["extensions"].empty()) entry.erase("extensions");
    lists_.materials.push_back(std::move(entry));
  }

  void add_emission(const Material& material, Json& entry) {
    entry["emissiveTexture"] = {{"index", material.emissive}};
    entry["emissiveFactor"] = {1, 1, 1};
    if (material.emissive_strength == 1) return;
    entry["extensions"]["KHR_materials_emissive_strength"] = {
        {"emissiveStrength", material.emissive_strength}};
    use("KHR_materials_emissive_strength");
  }

  void add_finish(const MaterialFinish& finish, Json& entry) {
    MaterialFinish seen = finish_in(to_text(finish));
    seen.thickness /=
        finest_.scale;  // lengths are in the mesh's own numbers, which its node scales
    for (const std::string& name : extensions_of(seen)) {
      Json& extension = entry["extensions"][name] = Json::object();
      for (const FinishTerm& term : finish_terms()) {
        const std::vector<double> numbers = numbers_of(term, seen);
        if (name != std::string("KHR_materials_") + term.extension ||
            numbers == numbers_of(term, MaterialFinish()))
          continue;
        extension[term.key] = term.number ? Json(numbers[0]) : Json(numbers);
      }
      use(name);
    }
  }

  /// Those of the levels that follow.
  void add_coarse_materials() {
    first_material_ = lists_.materials.size();
    for (Material material : asset_.materials) {
      material.normal = -1;
      add_material(material);
    }
  }

  // --- buffers ---

  std::size_t add_view(const PlacedView& placed) { return add_view(placed, Json::object()); }

  std::size_t add_view(const PlacedView& placed, Json more) {
    Json view{{"buffer", 0}, {"byteOffset", placed.offset}, {"byteLength", placed.length}};
    view.update(more);
    lists_.views.push_back(std::move(view));
    return lists_.views.size() - 1;
  }

  std::size_t add_rows_view(const PackedRows& rows, ViewUse use_of_view) {
    Json more = Json::object();
    const std::size_t packed_row = rows.bytes.size() / std::max<std::size_t>(rows.count, 1);
    if (use_of_view == ViewUse::Vertices) {
      more["byteStride"] = packed_row;
      more["target"] = ArrayBuffer;
    } else if (use_of_view == ViewUse::Indices) {
      more["target"] = ElementArrayBuffer;
    }
    PlacedView placed = buffer_.place(rows, use_of_view);
    if (!placed.compressed) return add_view(placed, std::move(more));
    more["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},
        {"byteOffset", placed.offset},
        {"byteLength", placed.length},
        {"byteStride", packed_row},
        {"count", rows.count},
        {"mode", use_of_view == ViewUse::Vertices ? "ATTRIBUTES" : "TRIANGLES"}};
    if (rows.octahedral) more["extensions"]["EXT_meshopt_compression"]["filter"] = "OCTAHEDRAL";
    more["buffer"] = 1;
    return add_view({placed.raw_offset, placed.raw_length}, std::move(more));
  }

  std::size_t add_accessor(const PackedRows& rows, ViewUse use_of_view) {
    Json accessor{{"bufferView", add_rows_view(rows, use_of_view)},
                  {"componentType", static_cast<int>(rows.type)},
                  {"count", rows.count},
                  {"type", type_name(rows.components)}};
    if (rows.normalised) accessor["normalized"] = true;
    if (!rows.least.empty()) {
      accessor["min"] = rows.least;
      accessor["max"] = rows.greatest;
    }
    lists_.accessors.push_back(std::move(accessor));
    return lists_.accessors.size() - 1;
  }

  // --- geometry ---

  std::size_t add_vectors(const FloatRows& rows) {
    const bool octahedral = options_.quantise && options_.compress;
    return add_accessor(octahedral          ? pack_octahedral(rows)
                        : options_.quantise ? pack_signed(rows)
                                            : pack_floats(rows),
                        ViewUse::Vertices);
  }

  Json attributes_of(const Surface& surface, const Quantisation& quantisation) {
    Json attributes;
    attributes["POSITION"] =
        add_accessor(options_.quantise ? pack_quantised(surface.positions, quantisation)
                                       : pack_floats(surface.positions, Bounds::Store),
                     ViewUse::Vertices);
    if (surface.normals.size() > 0) attributes["NORMAL"] = add_vectors(surface.normals);
    if (surface.tangents.size() > 0) attributes["TANGENT"] = add_vectors(surface.tangents);
    for (std::size_t i = 0; i < surface.texcoords.size(); ++i) {
      const FloatRows& uv = surface.texcoords[i];
      const bool fits = fits_integers(uv);
      attributes["TEXCOORD_" + std::to_string(i)] = add_accessor(
          options_.quantise && fits ? pack_unsigned(uv) : pack_floats(uv), ViewUse::Vertices);
    }
    if (!surface.colours.empty())
      attributes["COLOR_0"] = add_accessor(pack_colours(surface.colours), ViewUse::Vertices);
    for (const CustomAttribute& custom : surface.custom)
      attributes[custom.name] = add_accessor(pack_floats(custom.values), ViewUse::Vertices);
    return attributes;
  }

  Json targets_of(const Surface& surface, double scale) {
    Json targets = Json::array();
    for (const MorphTarget& target : surface.targets) {
      const FloatRows positions = target.positions / static_cast<float>(scale);
      Json entry{
          {"POSITION", add_accessor(pack_floats(positions, Bounds::Store), ViewUse::Vertices)}};
      if (target.normals.size() > 0)
        entry["NORMAL"] = add_accessor(pack_floats(target.normals), ViewUse::Vertices);
      if (target.tangents.size() > 0)
        entry["TANGENT"] = add_accessor(pack_floats(target.tangents), ViewUse::Vertices);
      targets.push_back(std::move(entry));
    }
    return targets;
  }

  Quantisation numbers_of_positions(const Surface& surface) const {
    return options_.quantise ? quantisation_of(surface.positions) : Quantisation{};
  }

  void add_node(const Surface& surface) {
    const Quantisation quantisation = numbers_of_positions(surface);
    Json primitive{{"attributes", attributes_of(surface, quantisation)},
                   {"indices", add_accessor(pack_indices(surface.indices, surface.vertex_count()),
                                            ViewUse::Indices)}};
    if (!asset_.materials.empty()) primitive["material"] = first_material_;
    if (!surface.targets.empty()) primitive["targets"] = targets_of(surface, quantisation.scale);
    if (asset_.materials.size() > 1) {
      Json mappings = Json::array();
      for (std::size_t i = 0; i < asset_.materials.size(); ++i)
        mappings.push_back({{"material", first_material_ + i}, {"variants", {i}}});
      primitive["extensions"]["KHR_materials_variants"]["mappings"] = std::move(mappings);
    }
    Json mesh{{"name", asset_.name}, {"primitives", {std::move(primitive)}}};
    if (!surface.targets.empty()) {
      mesh["weights"] = std::vector<int>(surface.targets.size(), 0);
      for (const MorphTarget& target : surface.targets)
        mesh["extras"]["targetNames"].push_back(target.name);
    }
    Json node{{"name", asset_.name}, {"mesh", lists_.meshes.size()}};
    const Eigen::RowVector3d translation = surface.origin + quantisation.offset;
    const double scale = quantisation.scale;
    if (options_.quantise || !translation.isZero(0))
      node["translation"] = {translation[0], translation[1], translation[2]};
    if (options_.quantise) {
      use("KHR_mesh_quantization", true);
      node["scale"] = {scale, scale, scale};
    }
    lists_.meshes.push_back(std::move(mesh));
    lists_.nodes.push_back(std::move(node));
  }

  // --- what hangs on them ---

  void add_levels_of_detail() {
    lists_.scenes.push_back({{"nodes", {0}}});
    if (asset_.levels.size() < 2) return;
    Json ids = Json::array(), coverages = Json::array();
    double coverage = 0.5;  // of the screen's height, halved from level to level
    for (std::size_t level = 1; level < asset_.levels.size(); ++level) {
      ids.push_back(level);
      coverages.push_back(coverage);
      coverage /= 2;
    }
    coverages.push_back(0);
    lists_.nodes[0]["extras"]["MSFT_screencoverage"] = std::move(coverages);
    // In a scene that is not shown, or who does not know the extension takes them for unused.
    lists_.scenes.push_back({{"name", "levels of detail"}, {"nodes", ids}});
    lists_.nodes[0]["extensions"]["MSFT_lod"]["ids"] = std::move(ids);
    use("MSFT_lod");
  }

  void add_variants() {
    if (asset_.materials.size() < 2) return;
    Json variants = Json::array();
    for (const Material& material : asset_.materials) variants.push_back({{"name", material.name}});
    root_["extensions"]["KHR_materials_variants"]["variants"] = std::move(variants);
    use("KHR_materials_variants");
  }

  /// All weights 0, then each target in turn at 1, then 0 again; a rest at each.
  void add_animation() {
    const auto targets = static_cast<Eigen::Index>(asset_.levels.front().targets.size());
    if (targets == 0) return;
    const Eigen::Index keys = 2 * (targets + 1) + 1;
    FloatRows times(keys, 1), weights = FloatRows::Zero(keys * targets, 1);
    double time = 0;
    for (Eigen::Index key = 0; key < keys; ++key) {
      times(key, 0) = static_cast<float>(time);
      time += key % 2 == 0 ? morph_rest_seconds : morph_change_seconds;
      const Eigen::Index state = key / 2;  // 0: the mesh itself, at the start
      if (state >= 1 && state <= targets) weights(key * targets + state - 1, 0) = 1;
    }
    const std::size_t input = add_accessor(pack_floats(times, Bounds::Store), ViewUse::Other);
    const std::size_t output = add_accessor(pack_floats(weights), ViewUse::Other);
    lists_.animations.push_back(
        {{"name", "morph"},
         {"samplers", {{{"input", input}, {"interpolation", "LINEAR"}, {"output", output}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  }

  // --- the container ---

  GltfFiles finish() {
    if (options_.compress) use("EXT_meshopt_compression", true);
    if (!asset_.images.empty()) {
      root_["samplers"] = {{{"magFilter", Linear},
                            {"minFilter", LinearMipmapLinear},
                            {"wrapS", Repeat},
                            {"wrapT", ClampToEdge}}};
    }
    if (!used_.empty()) root_["extensionsUsed"] = used_;
    if (!required_.empty()) root_["extensionsRequired"] = required_;
    std::string bytes = buffer_.take();
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    Json buffer{{"byteLength", bytes.size()}};
    if (options_.container == GltfContainer::Embedded) {
      buffer["uri"] = data_uri("application/octet-stream", bytes);
    } else if (options_.container == GltfContainer::Separate) {
      buffer["uri"] = uri_of_file(options_.stem + ".bin");
    }
    lists_.buffers.push_back(std::move(buffer));
    if (options_.compress) {
      lists_.buffers.push_back(
          {{"byteLength", buffer_.raw_size()},
           {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    }
    add_lists();
    if (options_.container == GltfContainer::Binary) return {{"", glb_container(text(-1), bytes)}};
    GltfFiles files{{"", text(1)}};
    if (options_.container == GltfContainer::Separate)
      files.emplace_back(options_.stem + ".bin", std::move(bytes));
    files.insert(files.end(), files_.begin(), files_.end());
    return files;
  }

  /// Names of files need not be UTF-8, which JSON is.
  std::string text(int indent) const {
    return root_.dump(indent, ' ', false, Json::error_handler_t::replace);
  }

  void add_lists() {
    for (const auto& [name, list] : {std::pair<const char*, Json*>{"scenes", &lists_.scenes},
                                     {"nodes", &lists_.nodes},
                                     {"meshes", &lists_.meshes},
                                     {"materials", &lists_.materials},
                                     {"textures", &lists_.textures},
                                     {"images", &lists_.images},
                                     {"animations", &lists_.animations},
                                     {"accessors", &lists_.accessors},
                                     {"bufferViews", &lists_.views},
                                     {"buffers", &lists_.buffers}}) {
      if (!list->empty()) root_[name] = std::move(*list);
    }
  }

  std::size_t first_material_ = 0;  // of the level that is added
  const Asset& asset_;
  const GltfOptions& options_;
  Quantisation finest_;  // of the level that materials are for; the others have its size
  BufferBytes buffer_;
  Json root_;
  /// The lists of the root, apart: a new key there moves all others.
  struct {
    Json scenes, nodes, meshes, materials, textures, images, animations, accessors, views, buffers;
  } lists_;
  std::set<std::string> used_, required_;
  GltfFiles files_;
};

void require_triangles(const Asset& asset) {
  const auto is_empty = [](const Surface& level) { return level.indices.empty(); };
  if (asset.levels.empty() || std::ranges::any_of(asset.levels, is_empty))
    throw std::invalid_argument("an asset needs a level, and each of its levels triangles");
}

}  // namespace

GltfFiles write_gltf(const Asset& asset, const GltfOptions& options) {
  require_one_of("container", options.container, GltfContainer::Embedded);
  require_triangles(asset);
  return Builder(asset, options).build();
}

std::string glb_bytes(const Asset& asset, GltfOptions options) {
  options.container = GltfContainer::Binary;
  return std::move(write_gltf(asset, options).front().second);
}

}  // namespace sphparam
