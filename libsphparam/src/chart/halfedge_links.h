#pragma once

#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// The half-edges of a closed triangle mesh that changes, as those of `Topology`, which does not.
class HalfedgeLinks {
 public:
  Halfedge twin(Halfedge h) const { return twin_[static_cast<size_t>(h)]; }
  Vertex origin(Halfedge h) const { return origin_[static_cast<size_t>(h)]; }
  Vertex target(Halfedge h) const { return origin(Topology::next(h)); }
  Vertex apex(Halfedge h) const { return origin(Topology::previous(h)); }
  Halfedge rotate_ccw(Halfedge h) const { return twin(Topology::previous(h)); }

 protected:
  explicit HalfedgeLinks(int halfedges)
      : origin_(static_cast<size_t>(halfedges)), twin_(origin_.size()) {}

  void set_origin(Halfedge h, Vertex v) { origin_[static_cast<size_t>(h)] = v; }
  /// As they are in another mesh with the same half-edges.
  void link_as(const Topology& topology, Halfedge h) {
    set_origin(h, topology.origin(h));
    twin_[static_cast<size_t>(h)] = topology.twin(h);
  }
  void join(Halfedge h, Halfedge other) {
    twin_[static_cast<size_t>(h)] = other;
    twin_[static_cast<size_t>(other)] = h;
  }

  std::vector<Vertex> origin_;
  std::vector<Halfedge> twin_;
};

}  // namespace sphparam
