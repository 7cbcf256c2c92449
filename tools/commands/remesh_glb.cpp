// The mesh just made as `export` writes it. A texture is baked from the source, whose directions
// are the same: the coordinates carried are only as fine as the grid.

#include "commands/remesh_glb.h"

#include <filesystem>
#include <stdexcept>

#include "console/exit_codes.h"
#include "io/attributes/appearance.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"
#include "number_text.h"

namespace sphparam::cli {

namespace {

void add_errors(Asset& asset, std::span<const LevelOfDetail> levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string name = "level_" + std::to_string(i);
    asset.extras.emplace_back(name + "_grid", levels[i].mesh.name());
    asset.extras.emplace_back(name + "_rms", short_number(levels[i].distance.value().rms, 6));
    asset.extras.emplace_back(name + "_max", short_number(levels[i].distance.value().max, 6));
  }
}

Asset asset_of(const RemeshArguments& arguments, const MappedMesh& mapped,
               std::span<const LevelOfDetail> levels, Console& console) {
  const MappedMesh& made = levels.front().mesh;
  const bool textured = has_texcoords(made.file()) && !mapped.file().base_colours.empty();
  ExportOptions options{
      .name = is_stream(arguments.input)
                  ? "mesh"
                  : std::filesystem::path(arguments.input).filename().stem().string(),
      .source = display_name(arguments.input),
      .threads = arguments.threads,
      .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }};
  const Look look = make_look(textured ? mapped : made, options);
  for (const LevelOfDetail& level : levels.subspan(1)) options.coarser.push_back(level.mesh);
  Asset asset = make_asset(made, look, options);
  if (levels.size() > 1) add_errors(asset, levels);
  return asset;
}

}  // namespace

void add_glb(PendingFiles& files, const RemeshArguments& arguments, const MappedMesh& mapped,
             std::span<const LevelOfDetail> levels, Console& console) try {
  add_asset(files, arguments.output, asset_of(arguments, mapped, levels, console));
} catch (const LookError& error) {
  throw UsageMistake(error.what());
} catch (const std::range_error& error) {
  throw ReadError(display_name(arguments.input), error.what());
} catch (const std::length_error& error) {
  throw WriteError(output_name(arguments.output), error.what());
}

}  // namespace sphparam::cli
