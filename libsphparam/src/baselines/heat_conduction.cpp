#include <numbers>
#include <utility>
#include <vector>

#include "mesh/laplace_system.h"
#include "option_domain.h"
#include "sphparam/baselines/brechbuehler.h"

// Latitude: Σ_j (ϕ_j − ϕ_i) = 0, 0 and π at the poles. Longitude: the same without the poles, one
// vertex at 0, and less 2π for whoever looks west across the date line, more for who looks east.
// The date line climbs from the north pole to the neighbour of greatest latitude: latitude has no
// maximum but the south pole, so it gets there, and it has no chords.

namespace sphparam {
namespace {

std::vector<VertexRole> roles_with(const Topology& topology, VertexRole poles, Vertex north,
                                   Vertex south) {
  std::vector<VertexRole> roles(static_cast<size_t>(topology.vertex_count()), VertexRole::Free);
  roles[static_cast<size_t>(north)] = roles[static_cast<size_t>(south)] = poles;
  return roles;
}

std::vector<double> equal_conductances(const Topology& topology) {
  return std::vector<double>(static_cast<size_t>(topology.halfedge_count()), 1.0);
}

VectorX conduct_latitude(const Topology& topology, Vertex north, Vertex south, int threads) {
  LaplaceSystem system(topology, roles_with(topology, VertexRole::Fixed, north, south), true,
                       threads);
  system.factorise(equal_conductances(topology), threads);
  MatrixX values = MatrixX::Zero(topology.vertex_count(), 1);
  values(south, 0) = std::numbers::pi;
  return system.solve(values, {}, threads);
}

/// Empty where rounding leaves no way up: latitude is flat on protrusions that are too long for
/// doubles.
std::vector<Vertex> steepest_path(const Topology& topology, const VectorX& latitude, Vertex north,
                                  Vertex south) {
  std::vector<Vertex> path = {north};
  while (path.back() != south) {
    const Vertex here = path.back();
    Vertex best = here;
    topology.for_each_outgoing(here, [&](Halfedge h) {
      if (latitude[topology.target(h)] > latitude[best]) best = topology.target(h);
    });
    if (best == here) return {};
    path.push_back(best);
  }
  return path;
}

/// From the vertices of the date line to their neighbours in the west, and back.
std::vector<Jump> date_line_jumps(const Topology& topology, const std::vector<Vertex>& date_line) {
  std::vector<Jump> jumps;
  for (size_t k = 1; k + 1 < date_line.size(); ++k) {
    // Counter-clockwise from north to south lies the west.
    Halfedge h = topology.find_halfedge(date_line[k], date_line[k - 1]);
    for (h = topology.rotate_ccw(h); topology.target(h) != date_line[k + 1];
         h = topology.rotate_ccw(h)) {
      jumps.push_back({h, -2 * std::numbers::pi});
      jumps.push_back({topology.twin(h), 2 * std::numbers::pi});
    }
  }
  return jumps;
}

VectorX conduct_longitude(const Topology& topology, const std::vector<Vertex>& date_line,
                          int threads) {
  std::vector<VertexRole> roles =
      roles_with(topology, VertexRole::Removed, date_line.front(), date_line.back());
  roles[static_cast<size_t>(date_line[1])] = VertexRole::Fixed;
  LaplaceSystem system(topology, std::move(roles), true, threads);
  system.factorise(equal_conductances(topology), threads);
  return system.solve(MatrixX::Zero(topology.vertex_count(), 1),
                      {date_line_jumps(topology, date_line)}, threads);
}

}  // namespace

std::optional<LatitudeLongitude> conduct_heat(const Topology& topology, Vertex north, Vertex south,
                                              int threads) {
  require_vertex("north", north, topology.vertex_count());
  require_vertex("south", south, topology.vertex_count());
  if (north == south || topology.find_halfedge(north, south) >= 0) return std::nullopt;
  LatitudeLongitude map;
  map.latitude = conduct_latitude(topology, north, south, threads);
  map.date_line = steepest_path(topology, map.latitude, north, south);
  if (map.date_line.empty()) return std::nullopt;
  map.longitude = conduct_longitude(topology, map.date_line, threads);
  return map;
}

}  // namespace sphparam
