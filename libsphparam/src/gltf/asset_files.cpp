// Files of an asset and of a textured mesh: what they are called, what is checked once they are on
// the disk.

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "gltf/compact_order.h"
#include "gltf/export_domain.h"
#include "gltf/export_names.h"
#include "gltf/fillers_left_out.h"
#include "gltf/images/image_kind.h"
#include "gltf/level.h"
#include "gltf/library_maps.h"
#include "gltf/set_apart.h"
#include "gltf/side_files.h"
#include "gltf/stored_chart.h"
#include "gltf/textured_mesh.h"
#include "gltf/usd/usd_check.h"
#include "gltf/usd/usd_materials.h"
#include "gltf/written_check.h"
#include "io/attributes/finish_terms.h"
#include "io/attributes/remarks.h"
#include "io/attributes/whole_vector.h"
#include "io/formats/lossless_type.h"
#include "number_text.h"
#include "sphparam/errors.h"
#include "sphparam/gltf/export.h"
#include "sphparam/gltf/usd_writer.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

bool is_usd(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".usda" || extension == ".usdz";
}

/// What the path says, and the asset.
GltfOptions resolved(GltfOptions options, const std::string& path, const Asset& asset) {
  const std::string extension = is_stream(path) ? ".glb" : extension_of(path);
  if (extension != ".glb" && extension != ".gltf")
    throw std::invalid_argument("an asset is written as .glb, .gltf, .usda or .usdz, not as " +
                                extension);
  if (extension == ".glb") {
    options.container = GltfContainer::Binary;
  } else if (options.container == GltfContainer::Binary) {
    options.container = GltfContainer::Separate;
  }
  options.stem = stem_of_export(path);
  options.quantise = options.quantise || asset.quantised;
  return options;
}

std::string image_file(const std::string& path, const AssetImage& image) {
  return path_beside(path,
                     stem_of_export(path) + "_" + image.name + image_kind(image.bytes).extension);
}

bool is_obj(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension != ".obj" && extension != ".ply")
    throw std::invalid_argument("a textured mesh is written as .obj or .ply, not as " + extension);
  return extension == ".obj";
}

/// The one that texts name.
const AssetImage& shown_image(const Look& look) {
  if (look.images.empty() || look.materials.empty())
    throw std::invalid_argument("a textured mesh needs a look with an image, as of make_look");
  return look.images.front();
}

/// What a look has besides the image of its colours that a .ply, or .mtl, has no words for.
std::vector<std::string> beyond_texts(const Look& look, bool obj) {
  const Material& seen = look.materials.front();
  std::vector<std::string> words;
  if (obj) words = beyond_library(look);
  for (std::size_t i = 1; i < look.images.size() && !obj; ++i)
    words.push_back("the image " + look.images[i].name);
  if (seen.alpha_mode != AlphaMode::Opaque) words.emplace_back("how alpha is meant");
  std::ranges::copy(extensions_of(seen.finish), std::back_inserter(words));
  return words;
}

std::vector<std::string> warnings_of(const Look& look, bool obj) {
  std::vector<std::string> warnings = look.warnings;
  const std::vector<std::string> words = beyond_texts(look, obj);
  if (!words.empty()) add_loss(warnings, enumerated(words) + ": .glb and .gltf have room for that");
  return warnings;
}

std::string size_words(std::size_t bytes) {
  constexpr std::size_t few = 1000;
  return bytes < few ? std::to_string(bytes) + " bytes"
                     : short_number(static_cast<double>(bytes) / 1e6) + " MB";
}

/// 16-bit numbers that nobody judged while the asset was made, and told the folds of.
void require_quantisable(const std::string& path, const Asset& asset, const GltfOptions& options) {
  if (!options.quantise || asset.quantised) return;
  const long folds = folds_by_quantising(asset);
  if (folds == 0) return;
  throw NotCertifiedError(output_name(path) + ": " + counted(folds, "triangle", "triangles") +
                          " would fold in (u, v) as 16-bit numbers: an asset made with "
                          "ExportOptions::quantise says so");
}

/// Likewise, counted from below.
void require_flippable(const std::string& path, const Asset& asset) {
  if (asset.upward_v) return;
  const long folds = folds_by_flipping(asset);
  if (folds == 0) return;
  throw NotCertifiedError(output_name(path) + ": " + counted(folds, "triangle", "triangles") +
                          " would fold in (u, 1 - v): an asset made with "
                          "ExportOptions::upward_v says so");
}

/// What changes for the way it is stored; nothing: nothing does.
std::optional<Asset> as_stored(const Asset& given, const GltfOptions& options) {
  if (!options.compress && !options.quantise) return std::nullopt;
  Asset asset = given;
  for (Surface& level : asset.levels)
    if (options.quantise) set_apart(level.positions);
  return options.compress ? in_compact_order(std::move(asset)) : std::move(asset);
}

/// Files added one after the other, with their sizes: the one named first, and what is beside it.
class Adder {
 public:
  Adder(PendingFiles& files, std::string owner) : files_(files), owner_(std::move(owner)) {}

  void add(const std::string& path, std::string bytes, const BytesCheck& check = {}) {
    if (path != owner_) require_own_file(owner_, path, bytes);
    written_.emplace_back(path, bytes.size());
    files_.add(path, std::move(bytes), check);
  }
  WrittenFiles take() { return std::move(written_); }

 private:
  PendingFiles& files_;
  std::string owner_;
  WrittenFiles written_;
};

/// Numbers that are called as a component of the normals, which are written with all of theirs.
std::vector<std::string> replaced_by_normals(const MeshFile& source) {
  std::vector<std::string> names;
  for (const char* name : {"nx", "ny", "nz"})
    if (source.find_vertex_property(name) && !is_of_whole_vector(name, source.vertex_properties))
      names.emplace_back(name);
  return names;
}

/// What of the source's numbers a .ply or .obj has no place for.
void tell_numbers_lost(const MeshFile& source, const MeshFile& textured, bool obj,
                       std::vector<std::string>& warnings) {
  if (const auto names = replaced_by_normals(source); !names.empty())
    add_loss(warnings, enumerated(names) + " of vertices: the normals' stand there");
  if (obj) {
    if (const auto words = numbers_not_shown(textured); !words.empty())
      add_loss(warnings, joined(words, " and ") + ": .ply has room for that");
    return;
  }
  for (const auto* properties : {&textured.vertex_properties, &textured.face_properties})
    if (const auto names = labels_beyond_32_bits(*properties); !names.empty())
      add_loss(warnings, words_of_lost_labels(names));
}

/// What a library says after its image of the base colour.
std::string more_lines(const std::string& path, const Look& look,
                       const std::vector<MapStatement>& more) {
  std::string lines = library_numbers(look.materials.front());
  for (const MapStatement& map : more)
    lines += std::string(map.keyword) + " " +
             fs::path(image_file(path, map.image)).filename().string() + "\n";
  return lines;
}

/// The mesh in a file that names the image, as .obj with a library beside it, which says more.
void add_mesh_beside_image(Adder& adder, const std::string& path, MeshFile textured,
                           const std::string& image_path, const std::string& more,
                           const BytesCheck& check) {
  const std::string image_name = fs::path(image_path).filename().string();
  if (is_obj(path)) {
    const std::string library = fs::path(library_of(path)).filename().string();
    adder.add(path, obj_with_library(textured, library), check);
    adder.add(library_of(path), material_library(image_name) + more);
  } else {
    textured.comments.push_back("TextureFile " + image_name);
    adder.add(path, serialise_ply(textured), check);
  }
}

/// The names of write_usd are those of the files but for the layer's, which has that of the path.
UsdFiles usd_files(const std::string& path, const Asset& asset) {
  if (extension_of(path) == ".usdz") return {{"", usdz_bytes(asset)}};
  return write_usd(asset, stem_of_export(path));
}

WrittenFiles add_usd(PendingFiles& files, const std::string& path, const Asset& asset) {
  require_export_place(path);
  require_flippable(path, asset);
  Adder adder(files, path);
  for (auto& [name, bytes] : usd_files(path, asset)) {
    const BytesCheck check = [&](std::string_view on_disk) {
      check_written_usd(on_disk, output_name(path), asset);
    };
    name.empty() ? adder.add(path, std::move(bytes), check)
                 : adder.add(path_beside(path, name), std::move(bytes));
  }
  return adder.take();
}

}  // namespace

std::size_t bytes_of(const std::vector<AssetImage>& images) {
  std::size_t all = 0;
  for (const AssetImage& image : images) all += image.bytes.size();
  return all;
}

std::string words_of(const WrittenFiles& files, std::size_t image_bytes) {
  std::vector<std::string> parts;
  double all = 0, textures = static_cast<double>(image_bytes);
  for (const auto& [path, bytes] : files) {
    parts.push_back(fs::path(output_name(path)).filename().string() + " " + size_words(bytes));
    all += static_cast<double>(bytes);
  }
  // In a file of text three bytes are four characters.
  if (files.size() == 1 && extension_of(files.front().first) == ".gltf") textures *= 4.0 / 3;
  return joined(parts) + ", " + percent(textures / all, 2) + " of it images";
}

std::vector<std::string> asset_files(const std::string& path, const Asset& asset,
                                     const GltfOptions& given) {
  std::vector<std::string> names = {path};
  if (is_usd(path)) {
    if (extension_of(path) == ".usda")
      for (const int image : images_of_usd(asset))
        names.push_back(image_file(path, asset.images.at(static_cast<std::size_t>(image))));
    return names;
  }
  const GltfOptions options = resolved(given, path, asset);
  if (options.container != GltfContainer::Separate) return names;
  names.push_back(path_beside(path, options.stem + ".bin"));
  if (options.compress) return names;  // images are in the buffer then
  for (const AssetImage& image : asset.images) names.push_back(image_file(path, image));
  return names;
}

WrittenFiles add_asset(PendingFiles& files, const std::string& path, const Asset& given_asset,
                       const GltfOptions& given) {
  if (is_usd(path)) return add_usd(files, path, given_asset);
  const GltfOptions options = resolved(given, path, given_asset);
  require_quantisable(path, given_asset, options);
  const std::optional<Asset> changed = as_stored(given_asset, options);
  const Asset& asset = changed ? *changed : given_asset;
  const bool is_binary = options.container == GltfContainer::Binary;
  const auto check = [&](std::string_view glb) {
    check_written(glb, output_name(path), asset, options);
  };
  GltfFiles made = write_gltf(asset, options);
  if (!is_binary) check(glb_bytes(asset, options));
  Adder adder(files, path);
  for (auto& [name, bytes] : made) {
    const bool is_checked = name.empty() && is_binary;
    adder.add(name.empty() ? path : path_beside(path, name), std::move(bytes),
              is_checked ? BytesCheck(check) : BytesCheck());
  }
  return adder.take();
}

void write_asset(const std::string& path, const Asset& asset, const GltfOptions& options) {
  PendingFiles files;
  add_asset(files, path, asset, options);
  files.publish();
}

std::vector<std::string> textured_files(const std::string& path, const Look& look) {
  std::vector<std::string> names = {path};
  if (is_obj(path)) names.push_back(library_of(path));
  names.push_back(image_file(path, shown_image(look)));
  if (is_obj(path))
    for (const MapStatement& more : map_statements(look))
      names.push_back(image_file(path, more.image));
  return names;
}

void require_export_place(const std::string& path) {
  const std::string kind = extension_of(path);
  require_name_of_line(path);
  if (kind == ".obj") require_own_file(path, library_of(path));
  if (kind == ".gltf") require_own_file(path, path_beside(path, stem_of_export(path) + ".bin"));
}

TexturedFiles add_textured_mesh(PendingFiles& files, const std::string& path,
                                const MappedMesh& mapped, const Look& look,
                                const ExportOptions& options) {
  const AssetImage& image = shown_image(look);
  require_export_place(path);
  require_export_domain(options);
  const ExportChart chart = chart_of_level(mapped, options);
  const FillerMarks fillers = fillers_of_chart(chart.chart, mapped.fillers());
  MeshFile textured = without_fillers(
      textured_mesh(chart, mapped.file(), options.shape, options.up, options.threads));
  require_numbers(textured, path);
  TexturedFiles result{
      .chart = figures_of(chart), .warnings = warnings_of(look, is_obj(path)), .files = {}};
  const BytesCheck check = [&](std::string_view on_disk) {
    result.chart.stored = certify_written(on_disk, path, chart, fillers, options.threads);
  };
  tell_numbers_lost(mapped.file(), textured, is_obj(path), result.warnings);
  Adder adder(files, path);
  std::vector<MapStatement> more;
  if (is_obj(path)) more = map_statements(look);
  add_mesh_beside_image(adder, path, std::move(textured), image_file(path, image),
                        more_lines(path, look, more), check);
  adder.add(image_file(path, image), image.bytes);
  result.image_bytes = image.bytes.size();
  if (!look.textures.empty()) result.textures.push_back(look.textures.front());
  for (MapStatement& map : more) {
    result.image_bytes += map.image.bytes.size();
    result.textures.push_back(map.figures);
    const std::string map_path = image_file(path, map.image);
    adder.add(map_path, std::move(map.image.bytes));
  }
  result.files = adder.take();
  warn_of_moves(source_name(mapped, options), chart, result.warnings);
  warn_of_folds(source_name(mapped, options), result.chart, options.keep_topology, result.warnings);
  return result;
}

TexturedFiles write_textured_mesh(const std::string& path, const MappedMesh& mapped,
                                  const ExportOptions& options) {
  ExportOptions baking = options;
  baking.look.bake_colours = true;  // beside an image they are not seen there
  baking.look.for_text = true;
  PendingFiles files;
  TexturedFiles written =
      add_textured_mesh(files, path, mapped, make_look(mapped, baking), options);
  files.publish();
  return written;
}

}  // namespace sphparam
