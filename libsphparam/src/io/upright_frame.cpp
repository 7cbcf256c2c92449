#include "sphparam/io/upright_frame.h"

#include <algorithm>

namespace sphparam {
namespace {

std::string words(const UprightAxes& axes) {
  return name_of_direction(axes.up) + ", front " + name_of_direction(axes.front);
}

}  // namespace

ParameterizeOptions with_upright_frame(ParameterizeOptions options, const TriangleMesh& mesh,
                                       const Topology& topology, const UprightAxes& axes) {
  if (!options.poles) options.poles = poles_along(mesh, topology, axes.up);
  if (!options.meridian)
    options.meridian = vertex_along(mesh, axes.front, {options.poles->north, options.poles->south});
  return options;
}

std::string upright_words(const Parameterization& result, const TriangleMesh& mesh,
                          const Topology& topology, const UprightAxes& axes) {
  if (!result.poles || !result.meridian) return "";
  const ParameterizeOptions upright = with_upright_frame({}, mesh, topology, axes);
  const bool stands = result.poles->north == upright.poles->north &&
                      result.poles->south == upright.poles->south &&
                      *result.meridian == *upright.meridian;
  return stands ? words(axes) : "";
}

bool map_is_upright(const MeshFile& file, const UprightAxes& axes) {
  const Provenance lines = read_provenance(file);
  return std::ranges::find(lines, std::pair<std::string, std::string>("upright", words(axes))) !=
         lines.end();
}

}  // namespace sphparam
