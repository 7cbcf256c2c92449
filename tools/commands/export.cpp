// `sphparam export`: a mapped mesh → its chart → vertex buffers and images → files that were read
// back before they get their names.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "io/attributes/source_attributes.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/chart/chart_failure.h"
#include "console/exit_codes.h"
#include "arguments/export_arguments.h"
#include "commands/export_look.h"
#include "reports/export_report.h"
#include "console/interruption.h"
#include "commands/level_path.h"
#include "commands/mapped_source.h"
#include "console/paths.h"
#include "reports/wording.h"
#include "gltf/gltf_writer.h"
#include "gltf/image_kind.h"
#include "gltf/written_check.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"
#include "remesh/remesh.h"
#include "io/attributes/hard_edges.h"
#include "sphparam/stopwatch.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

namespace fs = std::filesystem;

GeometryOptions geometry_options(const ExportArguments& arguments, const MeshFile& file,
                                 const ExportLook& look) {
  GeometryOptions options{.shape = arguments.shape,
                          .morph = arguments.morph,
                          .up = up_of(arguments.up, file),
                          .threads = arguments.threads};
  options.buffers = {.uv = {.sixteen_bits = arguments.quantise && !arguments.keep_topology},
                     .tangents = look.has_normals(),
                     .colours = look.vertex_colours,
                     .theta_phi = arguments.theta_phi,
                     .position_lo = arguments.shape == ShapeKind::Sphere,
                     .source_texcoords = arguments.source_uv};
  return options;
}

ExportChartOptions chart_options(const ExportArguments& arguments, Console& console) {
  return {.convention = arguments.convention,
          .refine_poles = arguments.refine_poles,
          .keep_topology = arguments.keep_topology,
          .threads = arguments.threads,
          .progress = [&console](std::string_view stage, double fraction) {
            return console.progress(stage, fraction);
          }};
}

/// Throws NotCertifiedError where a chart that should be one-to-one is not.
ExportChart make_chart(const ExportArguments& arguments, const MeshFile& file, const SphereMap& map,
                       Console& console) {
  ExportChart chart = [&] {
    try {
      return export_chart(file.mesh, Topology(file.mesh, arguments.threads), map,
                          chart_options(arguments, console));
    } catch (const std::invalid_argument& error) {
      if (arguments.refine_poles <= 1) throw;
      throw UsageMistake(std::string("--refine-poles: ") + error.what());
    }
  }();
  if (!arguments.keep_topology && !chart.chart.certificate.one_to_one()) {
    throw NotCertifiedError(display_name(arguments.input) + ": " + chart_failure(chart.chart));
  }
  if (arguments.shape == ShapeKind::Mesh)
    chart.wedge_normals = split_at_hard_edges(chart.chart, file, arguments.threads);
  return chart;
}

/// Warns of what folds as stored, by number and first ids.
void tell_folds(const ExportArguments& arguments, const ExportChart& chart,
                const ChartCertificate& stored, Console& console) {
  std::vector<Face> wrong = stored.folded;
  wrong.insert(wrong.end(), stored.around_pole.begin(), stored.around_pole.end());
  std::ranges::sort(wrong);
  wrong.erase(std::ranges::unique(wrong).begin(), wrong.end());
  if (wrong.empty() && !stored.one_to_one()) {
    console.warning(display_name(arguments.input) + ": not one-to-one in (u, v) as stored, " +
                    std::to_string(stored.torn.size()) + " edges torn");
  }
  if (wrong.empty()) return;
  std::string line = std::to_string(wrong.size()) + " of " +
                     std::to_string(chart.chart.triangles.rows()) + " triangles fold in (u, v)" +
                     (arguments.keep_topology ? ", as no vertex may be added:"
                                              : " as stored, being smaller than its rounding:");
  constexpr size_t most_listed = 10;
  for (size_t i = 0; i < std::min(wrong.size(), most_listed); ++i)
    line += " " + std::to_string(wrong[i]);
  if (wrong.size() > most_listed) line += " …";
  console.warning(display_name(arguments.input) + ": " + line);
}

/// What is told of one exported mesh.
void tell_geometry(const ExportArguments& arguments, const ExportChart& chart,
                   const ExportGeometry& geometry, Console& console) {
  const auto& counts = chart.chart.counts;
  console.detail("  chart: " + std::to_string(counts.splits()) + " splits, " +
                 std::to_string(chart.chart.triangles.rows()) + " triangles, " +
                 std::to_string(geometry.surface.vertex_count()) + " vertices");
  tell_folds(arguments, chart, geometry.stored, console);
}

std::vector<std::pair<std::string, std::string>> provenance_extras(const ExportArguments& arguments,
                                                                   const MappedMesh& mapped) {
  std::vector<std::pair<std::string, std::string>> extras = {
      {"source", display_name(arguments.input)}};
  for (const auto& [key, value] : mapped.provenance()) extras.emplace_back("map_" + key, value);
  return extras;
}

/// Everything of one run on its way to the disk.
class Exporter {
 public:
  Exporter(const ExportArguments& arguments, Console& console)
      : arguments_(arguments), console_(console) {}

  void run() {
    check_first_places();
    mapped_ = read_mapped_source(arguments_.input, arguments_.sphere, arguments_.threads, console_);
    if (arguments_.source_uv && !has_texcoords(mapped_->file())) {
      throw UsageMistake("--source-uv: the mesh has no texture coordinates of its own");
    }
    console_.progress("images", 0);
    look_ = make_export_look(arguments_, *mapped_, console_);
    is_text() ? write_text() : write_gltf_files();
    if (!arguments_.json.empty()) {
      report_.input = arguments_.input;
      report_.seconds = stopwatch_.seconds();
      files_.add(arguments_.json, to_json(report_));
    }
    if (interrupted()) throw Cancelled();
    files_.publish();
    console_.clear_progress();
    console_.say(display_name(arguments_.input) + ": " + short_number(stopwatch_.seconds()) +
                 " s → " + output_name(arguments_.output));
  }

 private:
  bool is_text() const {
    const std::string extension = extension_of(arguments_.output);
    return extension == ".obj" || extension == ".ply";
  }

  /// What can be told of the outputs before work: the images' names come later.
  void check_first_places() const {
    Outputs outputs = {{"--json", arguments_.json}};
    const int files = arguments_.lod_style == LodStyle::Files ? arguments_.lods : 0;
    for (int level = 0; level <= files; ++level) {
      const std::string path = level_path(arguments_.output, level);
      outputs.emplace_back("-o", path);
      const std::string more = extension_of(path) == ".gltf"  ? ".bin"
                               : extension_of(path) == ".obj" ? ".mtl"
                                                              : "";
      if (more.empty() || arguments_.embedded) continue;
      outputs.emplace_back("-o", beside(path, fs::path(path).stem().string() + more));
    }
    check_places(inputs(), outputs);
  }

  std::vector<std::string> inputs() const {
    return {arguments_.input, arguments_.sphere, arguments_.texture, arguments_.normal,
            arguments_.occlusion};
  }

  /// Notes an output; refuses it where it is an input or another output.
  void take_place(const std::string& path) {
    places_.emplace_back("-o", path);
    check_places(inputs(), places_);
  }

  Asset new_asset(const ExportLook& look) const {
    Asset asset{.name = asset_name(),
                .levels = {},
                .images = look.images,
                .coarse_levels_have_normal_maps = !look.normals_given,
                .materials = look.materials,
                .extras = provenance_extras(arguments_, *mapped_)};
    return asset;
  }

  std::string asset_name() const {
    return is_stream(arguments_.input) ? "mesh"
                                       : fs::path(arguments_.input).filename().stem().string();
  }

  Surface add_level(const MeshFile& file, const SphereMap& map, const ExportLook& look,
                    Asset& asset) {
    const ExportChart chart = make_chart(arguments_, file, map, console_);
    ExportGeometry geometry =
        export_geometry(chart, file, geometry_options(arguments_, file, look));
    tell_geometry(arguments_, chart, geometry, console_);
    if (asset.levels.empty()) {
      for (auto& extra : chart_extras(chart, geometry, chart_options(arguments_, console_)))
        asset.extras.push_back(std::move(extra));
    }
    report_.add_level(chart, geometry);
    return std::move(geometry.surface);
  }

  void write_gltf_files() {
    Asset asset = new_asset(look_);
    asset.levels.push_back(add_level(mapped_->file(), mapped_->map(), look_, asset));
    const ExportLook coarse_look = without_given_normals(look_);
    if (arguments_.lods > 0 && look_.normals_given) {
      console_.warning("the normal map is of the finest mesh: coarser levels are without");
    }
    if (arguments_.lod_style == LodStyle::Msft) {
      for (int level = 1; level <= arguments_.lods; ++level) {
        const Remeshed coarse = coarser(level);
        asset.levels.push_back(add_level(coarse.file, coarse.map, coarse_look, asset));
      }
    }
    add_files(asset, level_path(arguments_.output, 0));
    if (arguments_.lod_style == LodStyle::Msft) return;
    for (int level = 1; level <= arguments_.lods; ++level) {
      const Remeshed coarse = coarser(level);
      Asset next = new_asset(coarse_look);
      next.levels.push_back(add_level(coarse.file, coarse.map, coarse_look, next));
      add_files(next, level_path(arguments_.output, level));
    }
  }

  /// The mesh on an icosahedron's grid, each edge cut in N: 10·N² + 2 vertices, a quarter from
  /// level to level.
  Remeshed coarser(int level) const {
    console_.progress("level " + std::to_string(level), 0);
    const double vertices = std::ldexp(static_cast<double>(mapped_->map().points.rows()), -2 * level);
    const int size = std::max(1, static_cast<int>(std::lround(std::sqrt(vertices / 10))));
    return remesh(mapped_->file(), mapped_->map(),
                  make_grid({GridKind::IcosahedronCut, size}, {.threads = arguments_.threads}),
                  {.sample = SampleMode::Cell,
                   .transfer = look_.vertex_colours ? std::vector<std::string>{"color"}
                                                    : std::vector<std::string>{},
                   .threads = arguments_.threads,
                   .progress = [&](std::string_view stage, double fraction) {
                     return console_.progress(stage, fraction);
                   }});
  }

  void add_files(const Asset& asset, const std::string& path) {
    console_.progress("write", 0);
    const bool is_binary = is_stream(path) || extension_of(path) == ".glb";
    const GltfOptions options{.container = is_binary             ? GltfContainer::Binary
                                           : arguments_.embedded ? GltfContainer::Embedded
                                                                 : GltfContainer::Separate,
                              .stem = fs::path(path).stem().string(),
                              .quantise = arguments_.quantise,
                              .compress = arguments_.compress};
    GltfFiles written = write_gltf(asset, options);
    const bool readable = !options.compress;
    if (!is_binary && readable)
      check_written(glb_bytes(asset, options), output_name(path), asset, options);
    for (auto& [name, bytes] : written) {
      const std::string target =
          name.empty() ? path : (fs::path(path).parent_path() / name).string();
      take_place(target);
      report_.outputs.emplace_back(target, bytes.size());
      const bool checked = name.empty() && is_binary && readable;
      files_.add(target, std::move(bytes), [&](std::string_view on_disk) {
        if (checked) check_written(on_disk, output_name(path), asset, options);
      });
    }
  }

  void write_text() {
    const MeshFile& file = mapped_->file();
    const ExportChart chart = make_chart(arguments_, file, mapped_->map(), console_);
    MeshFile textured = textured_mesh(chart, file, arguments_.shape, arguments_.threads);
    const std::string path = arguments_.output, stem = fs::path(path).stem().string();
    require_numbers(textured, path);
    ChartCertificate stored;
    const BytesCheck check = [&](std::string_view on_disk) {
      stored = certify_written(on_disk, path, chart, arguments_.threads);
    };
    const AssetImage& image = look_.images.front();
    const std::string image_name = stem + "_" + image.name + image_kind(image.bytes).extension;
    if (extension_of(path) == ".obj") {
      add(path, obj_with_library(textured, stem + ".mtl"), check);
      add(beside(path, stem + ".mtl"), material_library(image_name));
    } else {
      textured.comments.push_back("TextureFile " + image_name);
      add(path, serialise_ply(textured), check);
    }
    add(beside(path, image_name), image.bytes);
    ExportGeometry geometry;
    geometry.stored = stored;
    tell_folds(arguments_, chart, stored, console_);
    report_.add_level(chart, geometry);
  }

  static std::string beside(const std::string& path, const std::string& name) {
    return (fs::path(path).parent_path() / name).string();
  }

  void add(const std::string& path, std::string bytes, const BytesCheck& check = {}) {
    take_place(path);
    report_.outputs.emplace_back(path, bytes.size());
    files_.add(path, std::move(bytes), check);
  }

  const ExportArguments& arguments_;
  Console& console_;
  const Stopwatch stopwatch_;
  std::optional<MappedMesh> mapped_;  // read first
  ExportLook look_;
  Outputs places_ = {{"--json", arguments_.json}};
  ExportReport report_;
  PendingFiles files_;
};

int run_export(const ExportArguments& arguments) {
  check_export_arguments(arguments);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const OrderlyInterruption orderly;
  try {
    Exporter(arguments, console).run();
  } catch (const std::range_error& error) {
    throw ReadError(display_name(arguments.input), error.what());
  } catch (const std::length_error& error) {
    throw WriteError(output_name(arguments.output), error.what());
  }
  return Ok;
}

}  // namespace

Command declare_export(CLI::App& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = declare_export_arguments(program, *arguments);
  return {command, [arguments] { return run_export(*arguments); }};
}

}  // namespace sphparam::cli
