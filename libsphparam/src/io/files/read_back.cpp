#include "io/files/read_back.h"

namespace sphparam {

Certificate certify_read_back(const MeshFile& file, const SphereMap& map, const Topology& written,
                              int threads) {
  const bool as_wanted = written.is_of(file.mesh.triangles) &&
                         written.vertex_count() == static_cast<int>(file.mesh.vertex_count());
  if (as_wanted) return certify(written, map, threads);
  return certify(Topology(file.mesh, threads), map, threads);
}

}  // namespace sphparam
