#include "cli/source.h"

#include "mesh_io/mesh_reader.h"
#include "mesh_io/welding.h"

namespace sphparam::tools {

Source read_source(const std::string& path, const ReadOptions& options) {
  Source source;
  source.file = read_mesh(path, options);
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
