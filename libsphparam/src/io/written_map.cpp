#include "sphparam/io/written_map.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "sphparam/io/connectivity.h"
#include "sphparam/io/paths.h"

namespace sphparam {
namespace {

/// Whether this program wrote the bare sphere, which `map --repair` does of the mended mesh.
bool is_own_sphere(const MeshFile& file) {
  constexpr std::string_view created = "freesurfer created by sphparam";
  return !read_provenance(file).empty() || std::ranges::count(file.comments, created) > 0;
}

/// An asset's mesh is not the one that was mapped: it has vertices more, along seams.
std::string advice_on(const MeshSource& mesh, const MeshSource& map) {
  if (!read_sphere(map.file))
    return is_own_sphere(map.file) ? "; where `map` mended the mesh, the sphere is of that, which "
                                     "`sphparam repair` with the same options writes"
                                   : "";
  const bool asset = mesh.file.format.starts_with("glTF") &&
                     mesh.file.mesh.vertex_count() > map.file.mesh.vertex_count();
  return std::string(asset ? "; glTF repeats vertices along seams" : "") +
         "; the map holds the surface that it is of: give it alone";
}

}  // namespace

void require_connectivity_of(const MeshSource& mesh, const MeshSource& map,
                             const std::string& kind) {
  const std::string difference = connectivity_difference(mesh.file, map.file);
  if (difference.empty()) return;
  throw ReadError(display_name(map.path), "not a " + kind + " of " + display_name(mesh.path) +
                                              ": " + difference + advice_on(mesh, map));
}

WrittenMap read_map_of(const MeshSource& mesh, const std::string& path, const ReadOptions& options,
                       const std::string& kind) {
  MeshSource source = read_source(path, options);
  require_connectivity_of(mesh, source, kind);
  MeshFile file = std::move(source.file);
  SphereMap map = read_sphere(file).value_or(SphereMap{file.mesh.positions});
  Provenance provenance = read_provenance(file);
  return {std::move(file), std::move(map), std::move(provenance)};
}

}  // namespace sphparam
