#pragma once

#include <optional>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Half-edge connectivity of a closed, oriented, manifold triangle mesh.
///
/// Half-edge h = 3·face + corner runs from that corner's vertex to the next corner's; only twins
/// and one outgoing half-edge a vertex are stored. Every component is allowed: genus and
/// connectedness are the business of `inspect_mesh`.
/// Our own: the smallest structure that answers the questions of the paper's 1-rings.
class Topology {
 public:
  /// Requires: every directed edge occurs once, its opposite once; one fan of faces a vertex; no
  ///           unused vertex.
  /// Throws: MeshError naming every defect, if not; length_error for more than INT_MAX/3 faces.
  /// Cost: O(#V + #F), about 30 bytes a triangle. `threads`, 0: all cores.
  explicit Topology(const TriangleMesh& mesh, int threads = 0);
  Topology(const Triangles& triangles, int vertex_count, int threads = 0);
  /// The same; nothing instead of an exception, and unused vertices are allowed (they have no
  /// outgoing half-edge, −1).
  static std::optional<Topology> try_build(const Triangles& triangles, int vertex_count,
                                           int threads = 0);

  /// Is this the connectivity of these triangles, corner by corner? Cost: one comparison of bytes.
  bool is_of(const Triangles& triangles) const;

  int vertex_count() const { return static_cast<int>(outgoing_.size()); }
  int face_count() const { return static_cast<int>(origin_.size() / 3); }
  int halfedge_count() const { return static_cast<int>(origin_.size()); }
  int edge_count() const { return halfedge_count() / 2; }

  /// The face that h runs around, and at which of its corners h starts.
  static Face face(Halfedge h) { return h / 3; }
  static int corner(Halfedge h) { return h % 3; }
  /// The half-edges before and after h in its face.
  static Halfedge next(Halfedge h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Halfedge previous(Halfedge h) { return h % 3 == 0 ? h + 2 : h - 1; }

  /// The half-edge that runs the other way, in the face across the edge.
  Halfedge twin(Halfedge h) const { return twin_[static_cast<size_t>(h)]; }
  Vertex origin(Halfedge h) const { return origin_[static_cast<size_t>(h)]; }
  Vertex target(Halfedge h) const { return origin(next(h)); }
  /// The vertex of h's face that is not on h.
  Vertex apex(Halfedge h) const { return origin(previous(h)); }
  Vertex vertex(Face f, int corner) const { return origin(3 * f + corner); }

  /// Some half-edge that starts at v.
  Halfedge outgoing(Vertex v) const { return outgoing_[static_cast<size_t>(v)]; }
  /// The next half-edge with the same origin, counter-clockwise seen from outside.
  Halfedge rotate_ccw(Halfedge h) const { return twin(previous(h)); }
  /// The next half-edge with the same origin, clockwise.
  Halfedge rotate_cw(Halfedge h) const { return next(twin(h)); }

  /// Calls visit(h) for every half-edge that starts at v, counter-clockwise from `outgoing(v)`.
  template <class Visit>
  void for_each_outgoing(Vertex v, Visit&& visit) const {
    const Halfedge first = outgoing(v);
    Halfedge h = first;
    do {
      visit(h);
      h = rotate_ccw(h);
    } while (h != first);
  }

  /// Number of edges (and of faces) at v.
  int valence(Vertex v) const;
  /// The half-edge from a to b, or -1. Cost: O(valence of a).
  Halfedge find_halfedge(Vertex a, Vertex b) const;

 private:
  Topology() = default;
  /// False at the first thing that is not as it should be.
  bool build(const Triangles& triangles, int vertex_count, int threads);

  std::vector<Vertex> origin_;      // of each half-edge
  std::vector<Halfedge> twin_;      // of each half-edge
  std::vector<Halfedge> outgoing_;  // of each vertex
};

}  // namespace sphparam
