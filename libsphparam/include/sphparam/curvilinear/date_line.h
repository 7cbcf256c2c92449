#pragma once

#include <vector>

#include "sphparam/curvilinear/poles.h"

namespace sphparam {

/// The path where θ begins and ends. (Triangles across θ = 0 are split in chart/, for textures.)
struct DateLine {
  std::vector<Vertex> path;  // north … south, poles included, along edges
};

/// The shortest path between the poles along edges; where it runs along a pole's link (a tie) it
/// takes the spoke instead, so that it leaves and enters a link once.
/// Paper: Section 6, "we used the Dijkstra algorithm for the computation of shortest paths".
/// Requires: usable poles. Cost: one Dijkstra sweep.
DateLine shortest_date_line(const TriangleMesh& mesh, const Topology& topology, Poles poles);

/// The path with the fewest edges among the given one's vertices: an induced path, no edge joins
/// two of its vertices that are not consecutive, so it touches each pole's link in one vertex.
/// Chords make a chart collapse: see robustness of convex combination maps, Floater 2003.
/// Requires: the path's ends are usable poles. Cost: O(total valence of the path).
DateLine induced_date_line(const Topology& topology, const DateLine& date_line);

/// True when no edge joins two vertices of the path that are not consecutive, and all consecutive
/// ones are joined.
bool is_induced(const Topology& topology, const DateLine& date_line);

}  // namespace sphparam
