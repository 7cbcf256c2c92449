// `sphparam export`: a mapped mesh → its chart → vertex buffers and images → files that were read
// back before they get their names.

#include "sphparam/gltf/export.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "arguments/export_arguments.h"
#include "arguments/part_files.h"
#include "commands/command.h"
#include "commands/lengths.h"
#include "commands/sources.h"
#include "console/places.h"
#include "io/attributes/appearance.h"
#include "io/attributes/remarks.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "sphparam/gltf/usd_writer.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/records/export_record.h"
#include "sphparam/remesh/levels_of_detail.h"
#include "sphparam/remesh/simplify.h"
#include "sphparam/render/coloured_values.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Write a mesh with spherical texture coordinates, for viewers and other programs.\n"
    "\n"
    "Examples:\n"
    "  sphparam export statue.sph.ply --image earth.png -o statue.glb\n"
    "  sphparam export statue.sph.ply --images bake/ --variants checker,graticule -o statue.glb\n"
    "  sphparam export statue.sph.ply --image earth.png --morph sphere -o statue.gltf\n"
    "  sphparam export statue.sph.ply --image earth.png --shape sphere -o ball.glb\n"
    "  sphparam export statue.sph.ply --image earth.png -o statue_earth.obj\n"
    "  sphparam export statue.sph.ply --images bake/ -o statue.usdz\n"
    "  sphparam export brain.sph.ply --scalar sulc --range -2,2 -o brain.glb\n"
    "\n"
    "Any equirectangular image sits right: the mesh is split along the date line and at the "
    "poles,\n"
    "every pole triangle has a vertex of its own there, u runs from 0 to 1 and never folds.\n"
    "Where the mesh has normals at corners, hard edges stay hard.\n"
    "Without an image the mesh shows its own texture, baked; else the colours of its vertices; "
    "else\n"
    "a checker, or white where a normal or occlusion map is given.\n"
    "Texture coordinates are certified as they are stored, rounding included; what folds there is "
    "told.\n"
    "A .glb, .usda, .usdz, .obj or .ply is read back from the disk and compared. A normal map\n"
    "is of one mesh: coarser --lods are without.\n";

ExportOptions export_options(const ExportArguments& arguments, Session& session) {
  ExportOptions options = arguments.exported;
  options.name = stem_or(arguments.input, "mesh");
  options.source = display_name(arguments.input);
  options.threads = session.threads();
  options.progress = session.progress();
  // On a sphere 16 bits would fold triangles that float32 does not.
  if (arguments.compress && options.shape != ShapeKind::Sphere) options.quantise = true;
  // Texts have an image in any case, beside which colours of vertices are not seen; nor does a
  // telephone show these.
  const std::string kind = extension_of(arguments.output);
  options.look.for_text = kind == ".obj" || kind == ".ply";
  options.look.bake_colours = options.look.for_text || kind == ".usdz";
  options.upward_v = kind == ".usda" || kind == ".usdz";
  return options;
}

/// What can be told of the outputs before work: the images' names come later.
void check_first_places(const ExportArguments& arguments) {
  Outputs outputs = {{"--json", arguments.json}};
  const int files = arguments.lod_style == LodStyle::Files ? arguments.levels() : 0;
  for (int level = 0; level <= files; ++level) {
    const std::filesystem::path path = level_path(arguments.output, level);
    outputs.emplace_back("-o", path.string());
    const std::string kind = extension_of(path.string());
    const std::string more = kind == ".gltf" ? ".bin" : kind == ".obj" ? ".mtl" : "";
    if (more.empty() || arguments.embedded) continue;
    outputs.emplace_back("-o", (path.parent_path() / (path.stem().string() + more)).string());
  }
  check_places(outputs);
  for (int level = 0; level <= files && !arguments.embedded; ++level)
    require_export_place(level_path(arguments.output, level));
}

Look look_of(const MappedMesh& mapped, const ExportOptions& options) try {
  return make_look(mapped, options);
} catch (const LookError& error) {
  throw UsageMistake(error.what());
} catch (const ImageOfOtherChart& error) {
  const std::string baked = std::to_string(error.refine_poles());
  throw UsageMistake("--refine-poles: " + display_name(error.path()) +
                     " is baked for --refine-poles " + baked +
                     ", and belongs to the triangles of that chart: `sphparam bake "
                     "--refine-poles " +
                     std::to_string(options.refine_poles) +
                     "` makes it for this one, or export with --refine-poles " + baked);
}

/// Everything of one run on its way to the disk.
class Exporter {
 public:
  Exporter(const ExportArguments& arguments, Session& session)
      : arguments_(arguments), session_(session), options_(export_options(arguments, session)) {}

  void add(const MappedMesh& mapped) try {
    const Look look = look_of(mapped, options_);
    record_.textures = look.textures;
    const std::string kind = extension_of(arguments_.output);
    kind == ".obj" || kind == ".ply" ? add_text(mapped, look) : add_assets(mapped, look);
  } catch (const std::invalid_argument& error) {
    if (options_.refine_poles <= 1) throw;
    throw UsageMistake(std::string("--refine-poles: ") + error.what());
  }

  /// "  statue.glb 3.4 MB, 62 % of it images", and what became of these.
  Words sizes() const {
    Words told = {"  " + words_of(record_.outputs, image_bytes_)};
    if (!record_.charts.empty())
      told.push_back(
          "  cut as its chart: " + counted(record_.charts.front().triangles, "triangle") + ", " +
          counted(record_.charts.front().vertices, "vertex", "vertices"));
    for (const std::string& remark : remarks_) told.push_back("  " + remark);
    if (options_.look.textures != TextureFormat::Given)
      told.push_back("  " + words_of(record_.textures));
    for (const std::string& line : level_lines(record_)) told.push_back("  " + line);
    return told;
  }

  /// A unit is a metre there.
  bool is_in_metres() const {
    const std::string kind = extension_of(arguments_.output);
    return kind != ".obj" && kind != ".ply";
  }

  const ExportRecord& record() {
    record_.input = arguments_.input;
    record_.seconds = session_.stopwatch.seconds();
    return record_;
  }

 private:
  /// Notes outputs; refuses them where they are inputs or other outputs.
  void take_places(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) places_.emplace_back("-o", path);
    check_places(places_);
  }

  void add_assets(const MappedMesh& mapped, const Look& look) {
    std::vector<MappedMesh> coarser =
        simplified_meshes(mapped, wanted_triangles(mapped),
                          {.threads = options_.threads, .progress = options_.progress});
    remarks_ = look.remarks;
    note_levels(mapped, coarser);
    measure(mapped, coarser);
    if (arguments_.lod_style == LodStyle::Msft) std::swap(options_.coarser, coarser);
    Asset finest = make_asset(mapped, look, options_);
    for (std::size_t level = 1; level < finest.levels.size(); ++level) add_error(finest, level);
    add_asset_at(0, finest);
    if (!coarser.empty() && look.normals_given) session_.console.warning(normals_left_out);
    const Look coarse_look = without_given_normals(look);
    int level = 0;
    for (const MappedMesh& coarse : coarser) {
      Asset asset = make_asset(coarse, coarse_look, options_);
      add_error(asset, static_cast<std::size_t>(++level));
      add_asset_at(level, asset);
    }
  }

  std::vector<long> wanted_triangles(const MappedMesh& mapped) const {
    if (arguments_.lod_faces.empty()) return quarters(mapped.mesh().face_count(), arguments_.lods);
    return arguments_.lod_faces;
  }

  void measure(const MappedMesh& mapped, const std::vector<MappedMesh>& coarser) {
    record_.diagonal = diagonal_of(mapped.mesh().positions);
    for (const MappedMesh& mesh : coarser) {
      record_.distances.push_back(distance_of(mapped, mesh));
      record_.in_space.push_back(faces_in_space(
          mapped, mesh,
          {.most_looks = usual_looks, .threads = options_.threads, .progress = options_.progress}));
    }
    session_.warn(warnings_of(record_));
    const auto unknown = std::ranges::count_if(
        record_.distances, [](const auto& distance) { return !distance.has_value(); });
    if (unknown == 0) return;
    session_.console.warning("--lods: how far " +
                             counted(unknown, "coarser mesh is", "coarser meshes are") +
                             " from the mesh cannot be told: there is no area to measure");
  }

  /// None where no distance means anything.
  std::optional<LevelOfDetail::Distance> distance_of(const MappedMesh& mapped,
                                                     const MappedMesh& coarser) const try {
    return distance_of_level(mapped, coarser, options_.threads, options_.progress);
  } catch (const UnmeasurableMesh&) {
    return std::nullopt;
  }

  /// Into the extras, by the names that `remesh` has.
  void add_error(Asset& asset, std::size_t level) const {
    const std::string name = "level_" + std::to_string(level);
    if (!record_.distances.at(level - 1)) return;
    const auto& [rms, max] = *record_.distances.at(level - 1);
    asset.extras.emplace_back(name + "_rms", short_number(rms, 6));
    asset.extras.emplace_back(name + "_max", short_number(max, 6));
  }

  void note_levels(const MappedMesh& mapped, const std::vector<MappedMesh>& coarser) {
    auto wanted = arguments_.lod_faces;
    const auto finer = static_cast<int>(
        std::erase_if(wanted, [&](auto count) { return count >= mapped.mesh().face_count(); }));
    if (finer > 0)
      session_.console.warning("--lod-faces: " + counted(finer, "level is", "levels are") +
                               " left out: the mesh has no more than " +
                               counted(mapped.mesh().face_count(), "triangle"));
    record_.lods_wanted = arguments_.levels();
    record_.lods = static_cast<int>(coarser.size());
    for (std::size_t i = 0; i < std::min(coarser.size(), wanted.size()); ++i)
      tell_count(coarser[i].mesh().face_count(), wanted[i]);
    if (record_.lods + finer == record_.lods_wanted) return;
    const MappedMesh& last = coarser.empty() ? mapped : coarser.back();
    session_.console.warning(
        (arguments_.lod_faces.empty() ? "--lods " + std::to_string(record_.lods_wanted)
                                      : std::string("--lod-faces")) +
        ": " + counted(record_.lods, "coarser mesh is", "coarser meshes are") +
        " written; the last has " + counted(last.mesh().face_count(), "triangle") +
        ", and none is coarser");
  }

  void tell_count(long triangles, long wanted) {
    if (triangles <= wanted) return;
    session_.console.warning("--lod-faces: " + counted(triangles, "triangle") + " instead of " +
                             std::to_string(wanted) + ": with fewer the map would fold");
  }

  void add_asset_at(int level, const Asset& asset) {
    const std::string path = level_path(arguments_.output, level);
    if (extension_of(path).starts_with(".usd")) session_.warn(beyond_usd(asset));
    for (std::size_t i = 0; i < asset.levels.size(); ++i)
      tell(asset.charts[i], asset.levels[i].vertex_count());
    session_.warn(asset.warnings);
    session_.console.progress("write", 0);
    const GltfOptions options{
        .container = arguments_.embedded ? GltfContainer::Embedded : GltfContainer::Separate,
        .compress = arguments_.compress};
    take_places(asset_files(path, asset, options));
    note(add_asset(session_.files, path, asset, options), bytes_of(asset.images));
  }

  void add_text(const MappedMesh& mapped, const Look& look) {
    take_places(textured_files(arguments_.output, look));
    TexturedFiles written =
        add_textured_mesh(session_.files, arguments_.output, mapped, look, options_);
    session_.warn(written.warnings);
    record_.textures = std::move(written.textures);  // the others are in no file
    record_.charts.push_back(std::move(written.chart));
    note(written.files, written.image_bytes);
  }

  void tell(const ChartFigures& chart, std::size_t vertices) {
    session_.console.detail("  chart: " + std::to_string(chart.splits) + " splits, " +
                            std::to_string(chart.triangles) + " triangles, " +
                            std::to_string(vertices) + " vertices");
    record_.charts.push_back(chart);
  }

  void note(const WrittenFiles& written, std::size_t image_bytes) {
    image_bytes_ += image_bytes;
    record_.outputs.insert(record_.outputs.end(), written.begin(), written.end());
  }

  const ExportArguments& arguments_;
  Session& session_;
  ExportOptions options_;
  Outputs places_ = {{"--json", arguments_.json}};
  ExportRecord record_;
  Words remarks_;                // on the images
  std::size_t image_bytes_ = 0;  // in all files
};

/// The images that `bake --all-components -o FOLDER/` made of a part, as if each were named.
void take_images_of_part(LookOptions& look, const std::string& stem) {
  const std::array<std::pair<const char*, std::string*>, 5> maps = {
      {{"basecolor", &look.texture},
       {"normal-tangent", &look.normal},
       {"ao", &look.occlusion},
       {"orm", &look.orm},
       {"emissive", &look.emissive}}};
  bool any = false;
  for (const auto& [map, image] : maps) {
    const std::filesystem::path path =
        std::filesystem::path(look.folder) / (stem + "_" + map + ".png");
    std::error_code hidden;
    if (!std::filesystem::exists(path, hidden)) continue;
    any = true;
    if (image->empty()) *image = path.string();
  }
  if (!any)
    throw ReadError(look.folder, "holds no image of " + stem + ": `bake --all-components -o " +
                                     shell_word(look.folder + "/") + "` makes them, as " + stem +
                                     "_basecolor.png");
  look.folder.clear();
}

/// The arguments for one part: its files, where it has its own.
ExportArguments of_part(ExportArguments arguments, int part) {
  arguments.input = path_of_part(arguments.input, part);
  arguments.output = path_of_part(arguments.output, part);
  LookOptions& look = arguments.exported.look;
  for (std::string* image :
       {&look.texture, &look.normal, &look.occlusion, &look.orm, &look.emissive})
    *image = file_for_part(*image, part);
  if (!look.folder.empty()) take_images_of_part(look, stem_of(arguments.input));
  return arguments;
}

/// Colours of the number that is to be seen.
void colour(MeshFile& file, const ExportArguments& arguments, Session& session) {
  const std::string& name = arguments.scalar;
  if (name.empty()) {
    const Words left_out = numbers_not_shown(file);
    const bool of_vertices = std::ranges::any_of(
        left_out, [](const std::string& words) { return words.ends_with(" of vertices"); });
    if (of_vertices)
      session.console.say("  a number of its vertices is seen as colours with --scalar NAME");
    return;
  }
  if (!file.find_vertex_property(name)) {
    const bool of_faces = file.find_face_property(name) != nullptr;
    Words names;
    for (const Property& property : file.vertex_properties) names.push_back(property.name);
    throw UsageMistake(
        "--scalar: " +
        (of_faces
             ? name + " is of faces: `bake --map scalar:" + name + " --heat` makes an --image"
             : "vertices have no '" + name + "'; " +
                   (names.empty() ? "they have no numbers" : "there are " + enumerated(names))));
  }
  file = with_scalar_colours(std::move(file), name, arguments.range);
  session.console.say("  " + file.comments.back());
}

/// The mesh with its map; what it lacks is told before it is mapped.
MappedMesh read_exported(const ExportArguments& arguments, Session& session) {
  session.hold_signals();
  MeshSource source = read_mended(arguments.input, arguments.repair, session);
  crease(source.file, arguments.input, arguments.crease, session);
  scale_by(arguments.scale, source.file, session);
  colour(source.file, arguments, session);
  if (arguments.exported.source_uv && !has_texcoords(source.file))
    throw UsageMistake("--source-uv: the mesh has no texture coordinates of its own");
  return map_source(std::move(source), arguments.sphere, session, arguments.repair);
}

std::string export_one(const ExportArguments& arguments, Session& session, Words& lines) {
  check_first_places(arguments);
  const LookOptions& look = arguments.exported.look;
  require_there({arguments.input, arguments.sphere, look.texture, look.normal, look.occlusion,
                 look.orm, look.emissive, look.folder});
  const MappedMesh mapped = read_exported(arguments, session);
  Exporter exporter(arguments, session);
  with_file_errors(arguments.input, arguments.output, [&] { exporter.add(mapped); });
  lines.push_back(display_name(arguments.input) + ": " + short_number(session.stopwatch.seconds()) +
                  " s → " + output_name(arguments.output));
  std::ranges::move(exporter.sizes(), std::back_inserter(lines));
  if (exporter.is_in_metres()) tell_size(mapped.mesh(), session);
  return to_json(exporter.record());
}

int run_export(ExportArguments& arguments) {
  check_export_arguments(arguments);
  Session session(arguments);
  Words lines;
  report_each("export", arguments.all_components, arguments.input, session, [&](int part) {
    return export_one(part > 0 ? of_part(arguments, part) : arguments, session, lines);
  });
  session.publish();
  for (const std::string& line : lines) session.console.say(line);
  return Ok;
}

}  // namespace

Command declare_export(CLI::App& program) {
  return make_command(program, "export", summary, declare_export_options, run_export);
}

}  // namespace sphparam::cli
