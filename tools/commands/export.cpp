// `sphparam export`: a mapped mesh → its chart → vertex buffers and images → files that were read
// back before they get their names.

#include "sphparam/gltf/export.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "arguments/export_arguments.h"
#include "arguments/suggestion.h"
#include "commands/mapped_source.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/level_path.h"
#include "console/paths.h"
#include "io/attributes/appearance.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/records/export_record.h"
#include "sphparam/remesh/levels_of_detail.h"
#include "sphparam/stopwatch.h"
#include "number_text.h"

namespace sphparam::cli {

namespace {

namespace fs = std::filesystem;

void require_known(const std::vector<std::string>& variants) {
  const std::vector<std::string>& words = variant_names();
  for (const std::string& name : variants) {
    if (std::ranges::find(words, name) != words.end()) continue;
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    const std::string meant = nearest_word(name, words);
    throw UsageMistake("--variants: no " + name + " among " + all +
                       (meant.empty() ? "" : "; did you mean " + meant + "?"));
  }
}

ExportOptions export_options(const ExportArguments& arguments, Console& console) {
  ExportOptions options = arguments.exported;
  options.name =
      is_stream(arguments.input) ? "mesh" : fs::path(arguments.input).filename().stem().string();
  options.source = display_name(arguments.input);
  options.progress = [&console](std::string_view stage, double fraction) {
    return console.progress(stage, fraction);
  };
  return options;
}

Look look_of(const MappedMesh& mapped, const ExportOptions& options) try {
  require_known(options.look.variants);
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
} catch (const std::invalid_argument& error) {
  throw UsageMistake(std::string("--refine-poles: ") + error.what());
}

/// Everything of one run on its way to the disk.
class Exporter {
 public:
  Exporter(const ExportArguments& arguments, Console& console)
      : arguments_(arguments), console_(console), options_(export_options(arguments, console)) {}

  void run() {
    check_first_places();
    const MappedMesh mapped =
        read_mapped_source(arguments_.input, arguments_.sphere, options_.threads, console_);
    if (options_.source_uv && !has_texcoords(mapped.file())) {
      throw UsageMistake("--source-uv: the mesh has no texture coordinates of its own");
    }
    const Look look = look_of(mapped, options_);
    const std::string kind = extension_of(arguments_.output);
    kind == ".obj" || kind == ".ply" ? add_text(mapped, look) : add_gltf(mapped, look);
    finish();
  }

 private:
  /// What can be told of the outputs before work: the images' names come later.
  void check_first_places() const {
    Outputs outputs = {{"--json", arguments_.json}};
    const int files = arguments_.lod_style == LodStyle::Files ? arguments_.lods : 0;
    for (int level = 0; level <= files; ++level) {
      const fs::path path = level_path(arguments_.output, level);
      outputs.emplace_back("-o", path.string());
      const std::string kind = extension_of(path.string());
      const char* more = kind == ".gltf" ? ".bin" : kind == ".obj" ? ".mtl" : "";
      if (!*more || arguments_.embedded) continue;
      outputs.emplace_back("-o", (path.parent_path() / (path.stem().string() + more)).string());
    }
    check_places(inputs(), outputs);
  }

  std::vector<std::string> inputs() const {
    const LookOptions& look = options_.look;
    return {arguments_.input, arguments_.sphere, look.texture, look.normal, look.occlusion};
  }

  /// Notes outputs; refuses them where they are inputs or other outputs.
  void take_places(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) places_.emplace_back("-o", path);
    check_places(inputs(), places_);
  }

  /// Meshes on icosahedra's grids, each edge cut in N: 10·N² + 2 vertices, a quarter from level to
  /// level.
  std::vector<MappedMesh> coarser(const MappedMesh& mapped, const Look& look) const {
    const auto finest = static_cast<double>(mapped.mesh().vertex_count());
    std::vector<GridSpec> grids;
    for (int level = 1; level <= arguments_.lods; ++level) {
      const double vertices = std::ldexp(finest, -2 * level);
      const int size = std::max(1, static_cast<int>(std::lround(std::sqrt(vertices / 10))));
      grids.push_back({GridKind::IcosahedronCut, size, 0});
    }
    using Names = std::vector<std::string>;
    std::vector<MappedMesh> levels;
    for (const LevelOfDetail& level :
         levels_of_detail(mapped, grids,
                          {.sample = SampleMode::Cell,
                          .transfer = look.vertex_colours ? Names{"color"} : Names{},
                          .measure = false,
                          .threads = options_.threads,
                          .progress = options_.progress})) {
      levels.emplace_back(MappedMesh::Parts{.file = level.mesh.file(),
                                            .map = level.mesh.map(),
                                            .provenance = mapped.provenance(),
                                            .topology = level.mesh.topology(),
                                            .name = options_.source},
                          options_.threads);
    }
    return levels;
  }

  void add_gltf(const MappedMesh& mapped, const Look& look) {
    std::vector<MappedMesh> levels = coarser(mapped, look);
    const bool in_one_file = arguments_.lod_style == LodStyle::Msft;
    ExportOptions options = options_;
    if (in_one_file) options.coarser = std::move(levels);
    add_files(level_path(arguments_.output, 0), asset_of(mapped, look, options));
    if (in_one_file) return;
    if (!levels.empty() && look.normals_given) console_.warning(normals_left_out);
    const Look coarse_look = without_given_normals(look);
    int level = 0;
    for (const MappedMesh& coarse : levels)
      add_files(level_path(arguments_.output, ++level), asset_of(coarse, coarse_look, options));
  }

  Asset asset_of(const MappedMesh& mapped, const Look& look, const ExportOptions& options) const {
    try {
      return make_asset(mapped, look, options);
    } catch (const std::invalid_argument& error) {
      if (options.refine_poles <= 1) throw;
      throw UsageMistake(std::string("--refine-poles: ") + error.what());
    }
  }

  void add_files(const std::string& path, const Asset& asset) {
    for (std::size_t level = 0; level < asset.levels.size(); ++level)
      tell(asset.charts[level], static_cast<long>(asset.levels[level].vertex_count()));
    for (const std::string& warning : asset.warnings) console_.warning(warning);
    console_.progress("write", 0);
    const GltfOptions options{
        .container = arguments_.embedded ? GltfContainer::Embedded : GltfContainer::Separate,
        .compress = arguments_.compress};
    take_places(asset_files(path, asset, options));
    note(add_asset(files_, path, asset, options));
  }

  void add_text(const MappedMesh& mapped, const Look& look) {
    take_places(textured_files(arguments_.output, look));
    try {
      TexturedFiles written = add_textured_mesh(files_, arguments_.output, mapped, look, options_);
      for (const std::string& warning : written.warnings) console_.warning(warning);
      report_.charts.push_back(std::move(written.chart));
      note(written.files);
    } catch (const std::invalid_argument& error) {
      if (options_.refine_poles <= 1) throw;
      throw UsageMistake(std::string("--refine-poles: ") + error.what());
    }
  }

  void tell(const ChartFigures& chart, long vertices) {
    console_.detail("  chart: " + std::to_string(chart.splits) + " splits, " +
                    std::to_string(chart.triangles) + " triangles, " + std::to_string(vertices) +
                    " vertices");
    report_.charts.push_back(chart);
  }

  void note(const WrittenFiles& written) {
    report_.outputs.insert(report_.outputs.end(), written.begin(), written.end());
  }

  void finish() {
    if (!arguments_.json.empty()) {
      report_.input = arguments_.input;
      report_.seconds = stopwatch_.seconds();
      files_.add(arguments_.json, to_json(report_));
    }
    if (interrupted()) throw Cancelled();
    files_.publish();
    console_.clear_progress();
    console_.say(options_.source + ": " + short_number(stopwatch_.seconds()) + " s → " +
                 output_name(arguments_.output));
  }

  const ExportArguments& arguments_;
  Console& console_;
  const ExportOptions options_;
  const Stopwatch stopwatch_;
  Outputs places_ = {{"--json", arguments_.json}};
  ExportRecord report_;
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
