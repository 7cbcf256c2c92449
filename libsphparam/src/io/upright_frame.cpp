#include "sphparam/io/upright_frame.h"

#include <algorithm>

#include "middle_poles.h"

namespace sphparam {
namespace {

std::string words(const UprightAxes& axes) {
  return name_of_direction(axes.up) + ", front " + name_of_direction(axes.front);
}

}  // namespace

ParameterizeOptions with_upright_frame(ParameterizeOptions options, const TriangleMesh& mesh,
                                       const Topology& topology, const UprightAxes& axes) {
  if (!options.poles)
    options.poles = middle_poles(mesh, topology, axes.up, options.fillers,
                                 poles_along(mesh, topology, axes.up));
  if (!options.meridian)
    options.meridian = vertex_along(mesh, axes.front, {options.poles->north, options.poles->south});
  return options;
}

std::string upright_words(const SphereMap& map, const TriangleMesh& mesh, const Topology& topology,
                          const UprightAxes& axes, const FillerMarks& fillers) {
  const ParameterizeOptions upright =
      with_upright_frame({.fillers = fillers}, mesh, topology, axes);
  const Vector3 front = map.point(*upright.meridian);
  const bool stands = map.point(upright.poles->north) == Vector3(0, 0, 1) &&
                      map.point(upright.poles->south) == Vector3(0, 0, -1) && front.y() == 0 &&
                      front.x() > 0;
  return stands ? words(axes) : "";
}

bool map_is_upright(const Provenance& lines, const UprightAxes& axes) {
  return std::ranges::find(lines, std::pair<std::string, std::string>("upright", words(axes))) !=
         lines.end();
}

bool map_is_upright(const MeshFile& file, const UprightAxes& axes) {
  return map_is_upright(read_provenance(file), axes);
}

}  // namespace sphparam
