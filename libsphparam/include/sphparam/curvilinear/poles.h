#pragma once

#include <optional>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// The vertices that go to ±z.
struct Poles {
  Vertex north;
  Vertex south;
};

/// Two vertices that are far from each other along the edges: the end of a longest shortest path,
/// by three sweeps of Dijkstra's algorithm (the first from vertex 0).
/// Paper: Section 6, "the poles should have sufficient distance"; the choice is our own.
/// Cost: three Dijkstra sweeps, O(#F log #F).
Poles farthest_poles(const TriangleMesh& mesh, const Topology& topology);

/// False when an edge joins two vertices of v's link that are not neighbours there: a separating
/// triangle at v. Everything behind that edge would collapse onto the boundary of the chart.
/// Our own: Floater's criterion for convex combination maps (2003) asks for it.
/// Cost: O(total valence of the link).
bool link_is_chord_free(const Topology& topology, Vertex v);

/// Both links are chord-free, and they are disjoint: the poles are at least three edges apart, so
/// that the mesh without them is a cylinder and the date line has two inner vertices.
bool poles_are_usable(const Topology& topology, Poles poles);

/// The given pair, each pole moved to a nearby vertex where needed to make the pair usable; nothing
/// where no such pair is found among the 64 nearest candidates a pole (all vertices of
/// a small mesh): so nothing for a tetrahedron, an octahedron, a bipyramid.
/// Throws: std::invalid_argument for a pole that is no vertex.
std::optional<Poles> nearest_usable_poles(const Topology& topology, Poles wanted);

/// `farthest_poles`, made usable by `nearest_usable_poles`.
std::optional<Poles> choose_poles(const TriangleMesh& mesh, const Topology& topology);

}  // namespace sphparam
