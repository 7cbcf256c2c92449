#include "pipeline/given_vertices.h"

#include <array>
#include <set>
#include <stdexcept>
#include <string>

namespace sphparam {
namespace {

void require_vertex(const Topology& topology, const char* what, Vertex v) {
  if (v >= 0 && v < topology.vertex_count()) return;
  throw MeshError({{DefectKind::IndexOutOfRange,
                    true,
                    1,
                    {v},
                    std::string(what) + " " + std::to_string(v) + " is not a vertex: there are " +
                        std::to_string(topology.vertex_count()),
                    ""}});
}

void require_pins(const Topology& topology, const ParameterizeOptions& options) {
  std::set<Vertex> seen;
  std::set<std::array<double, 3>> points;
  if (options.poles) seen = {options.poles->north, options.poles->south};
  for (const Landmark& pin : options.pins) {
    require_vertex(topology, "pin", pin.vertex);
    if (!seen.insert(pin.vertex).second) {
      throw std::invalid_argument("vertex " + std::to_string(pin.vertex) + " is pinned twice");
    }
    const Vector3 x = to_cartesian(pin.coordinates);
    if (!points.insert({x.x(), x.y(), x.z()}).second) {
      throw std::invalid_argument("vertex " + std::to_string(pin.vertex) +
                                  " is pinned where another one is");
    }
  }
}

}  // namespace

void require_given_vertices(const Topology& topology, const ParameterizeOptions& options) {
  if (options.poles) {
    require_vertex(topology, "pole", options.poles->north);
    require_vertex(topology, "pole", options.poles->south);
  }
  if (options.meridian) require_vertex(topology, "meridian", *options.meridian);
  require_pins(topology, options);
}

}  // namespace sphparam
