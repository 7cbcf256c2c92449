#include "cli/source.h"

#include <filesystem>

#include "mesh_io/mesh_reader.h"
#include "mesh_io/safe_file.h"
#include "mesh_io/welding.h"

namespace sphparam::tools {

namespace {

/// Textures that a file names are read too: no output may replace them.
void keep_textures(const MeshFile& file) {
  for (const BaseColour& colour : file.base_colours) {
    if (colour.path.empty()) continue;
    keep_from_outputs({(std::filesystem::path(colour.folder) / colour.path).string()});
  }
}

}  // namespace

Source read_source(const std::string& path, const ReadOptions& options) {
  Source source;
  source.file = read_mesh(path, options);
  keep_textures(source.file);
  source.inspection = inspect_mesh(source.file.mesh);
  source.notes = source.file.notes;
  MappableMesh mappable = make_mappable(std::move(source.file), &source.notes);
  source.file = std::move(mappable.file);
  source.topology = std::move(mappable.topology);
  // Dropping unused vertices leaves all used ones; welding merges some of these.
  source.welded = source.file.mesh.vertex_count() < source.inspection.used_vertices;
  if (source.welded) source.inspection = inspect_mesh(source.file.mesh);
  return source;
}

}  // namespace sphparam::tools
