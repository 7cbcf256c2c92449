#include "io/inspected_source.h"

#include "mesh/flat_face.h"
#include "sphparam/errors.h"
#include "sphparam/io/paths.h"

namespace sphparam {

bool is_inspected(const MeshSource& source) {
  return source.topology || source.inspection.faces > 0 || !source.inspection.defects.empty();
}

MeshSource inspected(MeshSource source) {
  source.inspection = inspect_mesh(source.file.mesh);
  if (source.inspection.is_sphere()) source.topology.emplace(source.file.mesh);
  return source;
}

bool is_mappable(const MeshSource& source) {
  return source.inspection.is_sphere() && has_area(source.file.mesh);
}

void require_area(const MeshSource& source) {
  if (has_area(source.file.mesh)) return;
  throw UnmeasurableMesh(display_name(source.path) +
                         ": the surface has no area that can be measured: each of its faces is a "
                         "line or a point, and there is no shape to map");
}

}  // namespace sphparam
