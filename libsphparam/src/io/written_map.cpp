#include "sphparam/io/written_map.h"

#include <utility>

#include "sphparam/io/connectivity.h"
#include "sphparam/io/paths.h"

namespace sphparam {

WrittenMap read_map_of(const MeshSource& mesh, const std::string& path, const ReadOptions& options,
                       const std::string& kind) {
  MeshFile file = read_source(path, options).file;
  const std::string difference = connectivity_difference(mesh.file, file);
  if (!difference.empty()) {
    throw ReadError(display_name(path),
                    "not a " + kind + " of " + display_name(mesh.path) + ": " + difference);
  }
  SphereMap map = read_sphere(file).value_or(SphereMap{file.mesh.positions});
  Provenance provenance = read_provenance(file);
  return {std::move(file), std::move(map), std::move(provenance)};
}

}  // namespace sphparam
