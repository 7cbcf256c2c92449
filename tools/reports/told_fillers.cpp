#include "reports/told_fillers.h"

#include <algorithm>

#include "number_text.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/sphere/sphere_share.h"

namespace sphparam::cli {

void tell_counted_fillers(const MappedMesh& mapped, const std::string& what, Console& console) {
  const FillerMarks& fillers = mapped.fillers();
  if (fillers.empty()) return;
  const auto count = std::count(fillers.begin(), fillers.end(), 1);
  const double share = sphere_share(mapped.mesh().triangles, mapped.map(), fillers);
  console.warning(mapped.name() + ": " +
                  counted(count, "filler of holes counts", "fillers of holes count") +
                  " as surface in " + what + ": " + percent(share) + " of the sphere");
}

void tell_changed_holes(const MappedMesh& source, const MappedMesh& made, Console& console) {
  if (source.fillers().empty()) return;
  const MeshInspection before = inspect_mesh(source.surface()),
                       after = inspect_mesh(made.surface());
  if (before.boundary_loops == after.boundary_loops) return;
  const double lost = before.area > 0 ? 1 - after.area / before.area : 0;
  console.warning(
      made.name() + ": " + counted(before.boundary_loops, "hole", "holes") + " before, " +
      std::to_string(after.boundary_loops) + " after" +
      (lost > 0 ? ", and " + percent(lost) + " of the area is lost" : "") +
      ": holes near the size of the grid's cells merge or close; a finer grid keeps them");
}

}  // namespace sphparam::cli
