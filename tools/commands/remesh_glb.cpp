#include "commands/remesh_glb.h"

#include "commands/file_errors.h"
#include "console/exit_codes.h"
#include "console/places.h"
#include "number_text.h"
#include "sphparam/gltf/export.h"

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
               std::span<const LevelOfDetail> levels, Session& session) try {
  const MappedMesh& made = levels.front().mesh;
  ExportOptions options{.name = stem_or(arguments.input, "mesh"),
                        .source = display_name(arguments.input),
                        .threads = session.threads(),
                        .progress = session.progress()};
  const Look look = make_look(made, mapped, options);
  for (const LevelOfDetail& level : levels.subspan(1)) options.coarser.push_back(level.mesh);
  Asset asset = make_asset(made, look, options);
  if (levels.size() > 1) add_errors(asset, levels);
  return asset;
} catch (const LookError& error) {
  throw UsageMistake(error.what());
}

}  // namespace

void add_glb(const RemeshArguments& arguments, const MappedMesh& mapped,
             std::span<const LevelOfDetail> levels, Session& session) {
  with_file_errors(arguments.input, arguments.output, [&] {
    add_asset(session.files, arguments.output, asset_of(arguments, mapped, levels, session));
  });
}

}  // namespace sphparam::cli
