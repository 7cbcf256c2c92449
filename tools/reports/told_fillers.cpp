#include "reports/told_fillers.h"

#include <algorithm>

#include "number_text.h"
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

}  // namespace sphparam::cli
