#include "io/inspected_source.h"

#include <utility>

namespace sphparam {

bool is_inspected(const MeshSource& source) {
  return source.topology || source.inspection.faces > 0 || !source.inspection.defects.empty();
}

MeshSource inspected(MeshSource source) {
  source.inspection = inspect_mesh(source.file.mesh);
  if (source.inspection.is_sphere()) source.topology.emplace(source.file.mesh);
  return source;
}

}  // namespace sphparam
