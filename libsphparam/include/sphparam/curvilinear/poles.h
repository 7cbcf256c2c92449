#pragma once

#include <optional>
#include <vector>

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

/// The vertex that is farthest along a direction. Of those that are as far but for 1e-4 of the
/// mesh's extent along it, as on a flat top, the one nearest to the line through the middle of the
/// surface; then the lowest index. Not one of those to leave out.
/// Requires: a direction of finite numbers that is not 0; a vertex that is not left out. Our own.
/// Cost: two passes over the vertices, one over the triangles.
Vertex vertex_along(const TriangleMesh& mesh, const Vector3& direction,
                    const std::vector<Vertex>& left_out = {});

/// The top and the bottom of a mesh: the vertices that are farthest along a direction and against
/// it; where they share an edge, as in meshes of a few vertices, others near them, if there are
/// such. Cost: that of `vertex_along` twice.
Poles poles_along(const TriangleMesh& mesh, const Topology& topology, const Vector3& up);

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
