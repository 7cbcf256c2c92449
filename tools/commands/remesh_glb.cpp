// The exporter's steps on the mesh just made: its chart, its vertex buffers, images, one file that
// is read back. A texture is baked from the source, whose directions are the same: the coordinates
// carried are only as fine as the grid.

#include "commands/remesh_glb.h"

#include <filesystem>
#include <stdexcept>

#include "io/attributes/source_attributes.h"
#include "sphparam/chart/chart_failure.h"
#include "console/exit_codes.h"
#include "commands/export_look.h"
#include "console/paths.h"
#include "reports/wording.h"
#include "gltf/gltf_writer.h"
#include "gltf/written_check.h"
#include "sphparam/io/read_options.h"
#include "io/attributes/hard_edges.h"

namespace sphparam::cli {

namespace {

ExportLook look_of(const RemeshArguments& arguments, const MappedMesh& mapped,
                   const MappedMesh& made, Console& console) {
  ExportArguments exporting;
  exporting.threads = arguments.threads;
  const bool textured = has_texcoords(made.file()) && !mapped.file().base_colours.empty();
  return make_export_look(exporting, textured ? mapped : made, console);
}

/// The new mesh as a source.
MappedMesh as_source(const Remeshed& result, int threads) {
  return MappedMesh({.file = result.file, .map = result.map, .polygons = result.faces}, threads);
}

ExportChart chart_of(const MappedMesh& made, const RemeshArguments& arguments,
                     const ExportChartOptions& options) {
  const TriangleMesh& mesh = made.file().mesh;
  ExportChart chart = export_chart(mesh, Topology(mesh, arguments.threads), made.map(), options);
  if (!chart.chart.certificate.one_to_one()) {
    throw NotCertifiedError(arguments.grid + ": " + chart_failure(chart.chart));
  }
  chart.wedge_normals = split_at_hard_edges(chart.chart, made.file(), arguments.threads);
  return chart;
}

Asset new_asset(const RemeshArguments& arguments, const Provenance& provenance, ExportLook look) {
  Asset asset;
  asset.name = is_stream(arguments.input)
                   ? "mesh"
                   : std::filesystem::path(arguments.input).filename().stem().string();
  asset.images = std::move(look.images);
  asset.materials = std::move(look.materials);
  asset.extras = {{"source", display_name(arguments.input)}};
  for (const auto& [key, value] : provenance) asset.extras.emplace_back("map_" + key, value);
  return asset;
}

void add_error(Asset& asset, const RemeshLevel& level) {
  const std::string name = "level_" + std::to_string(asset.levels.size());
  asset.extras.emplace_back(name + "_grid", level.arguments.grid);
  asset.extras.emplace_back(name + "_rms", short_number(level.rms, 6));
  asset.extras.emplace_back(name + "_max", short_number(level.max, 6));
}

Asset make_asset(const RemeshArguments& arguments, const MappedMesh& mapped,
                 std::span<const RemeshLevel> levels, const Provenance& provenance,
                 Console& console) {
  const ExportChartOptions options{.threads = arguments.threads};
  ExportLook look = look_of(arguments, mapped, as_source(levels.front().mesh, arguments.threads), console);
  const bool colours = look.vertex_colours;
  Asset asset = new_asset(arguments, provenance, std::move(look));
  for (const RemeshLevel& level : levels) {
    const MappedMesh made = as_source(level.mesh, arguments.threads);
    const MeshFile& file = made.file();
    const ExportChart chart = chart_of(made, level.arguments, options);
    ExportGeometry geometry = export_geometry(
        chart, file,
        {.up = up_axis(file), .buffers = {.colours = colours}, .threads = arguments.threads});
    if (asset.levels.empty()) {
      for (auto& extra : chart_extras(chart, geometry, options))
        asset.extras.push_back(std::move(extra));
    }
    if (levels.size() > 1) add_error(asset, level);
    asset.levels.push_back(std::move(geometry.surface));
  }
  return asset;
}

}  // namespace

void add_glb(PendingFiles& files, const RemeshArguments& arguments, const MappedMesh& mapped,
             std::span<const RemeshLevel> levels, const Provenance& provenance,
             Console& console) try {
  const Asset asset = make_asset(arguments, mapped, levels, provenance, console);
  files.add(arguments.output, glb_bytes(asset), [&](std::string_view written) {
    check_written(written, output_name(arguments.output), asset, {});
  });
} catch (const std::range_error& error) {
  throw ReadError(display_name(arguments.input), error.what());
} catch (const std::length_error& error) {
  throw WriteError(output_name(arguments.output), error.what());
}

}  // namespace sphparam::cli
