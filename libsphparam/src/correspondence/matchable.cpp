#include "correspondence/matchable.h"

#include <cmath>

#include "mesh/enclosed_volume.h"
#include "mesh/triangle_geometry.h"
#include "sphparam/errors.h"

namespace sphparam {

void require_area(const MappedMesh& mapped) {
  const double area = surface_area(mapped.surface());
  if (area > 0 && std::isfinite(area)) return;
  throw UnmeasurableMesh(mapped.name() + ": the surface has no area that can be measured");
}

std::optional<std::string> opposite_facing(const MappedMesh& from, const MappedMesh& to) {
  constexpr double next_to_nothing = 1e-4;
  for (const MappedMesh* mapped : {&from, &to})
    if (is_sheet(mapped->mesh(), mapped->fillers())) return std::nullopt;
  const double of_first = enclosed(from.mesh()), of_second = enclosed(to.mesh());
  const bool both_enclose =
      std::abs(of_first) > next_to_nothing && std::abs(of_second) > next_to_nothing;
  if (!both_enclose || (of_first < 0) == (of_second < 0)) return std::nullopt;
  const bool is_first = of_first < 0;
  return (is_first ? from : to).name() + " is inside out and " + (is_first ? to : from).name() +
         " is not, so that the map between them mirrors: --repair=orientation turns it over";
}

}  // namespace sphparam
