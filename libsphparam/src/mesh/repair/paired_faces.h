#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mesh/repair/repair_state.h"

namespace sphparam {

/// The faces of a RepairState joined side to side, and the three operations that change how:
/// half-edge h = 3·face + corner, its twin −1 at a boundary. Two edges may have the same two
/// vertices; `has_edge` sees both as one. Cost of all: O(1), expected, but for `collapse`.
class PairedFaces {
 public:
  /// twin: 3·#F. The state outlives this and is changed through it alone.
  PairedFaces(RepairState& state, std::vector<Halfedge> twin);

  Halfedge twin(Halfedge h) const { return twin_[h]; }
  static Halfedge next(Halfedge h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Halfedge previous(Halfedge h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Vertex origin(Halfedge h) const { return state_.corner(h); }
  Vertex target(Halfedge h) const { return origin(next(h)); }
  Vertex apex(Halfedge h) const { return origin(previous(h)); }
  bool has_edge(Vertex a, Vertex b) const { return uses_.contains(key(a, b)); }
  bool is_alive(Face f) const { return alive_[f]; }

  /// Whether the two faces of h can get the other diagonal, as an edge that is not there yet.
  bool can_turn(Halfedge h) const;
  void turn(Halfedge h);

  /// Puts a vertex at the middle of the edge; its one or two faces become two each.
  void split(Halfedge h);

  /// Whether the ends of h can become one vertex and the surface stays what it is (the link
  /// condition of Dey, Edelsbrunner, Guha & Nekhayev 1999). Requires: closed around both ends.
  /// Cost: O(the smaller valence); the same for `collapse`, which keeps the end of larger valence
  /// and returns it.
  bool can_collapse(Halfedge h) const;
  Vertex collapse(Halfedge h);

  /// Drops the faces that collapses left without extent.
  void finish();

 private:
  static std::uint64_t key(Vertex a, Vertex b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 |
           static_cast<std::uint64_t>(std::max(a, b));
  }
  void use(Vertex a, Vertex b) { ++uses_[key(a, b)]; }
  void release(Vertex a, Vertex b);
  void join(Halfedge g, Halfedge h);
  Halfedge split_side(Halfedge h, Vertex middle);
  Halfedge from_smaller_end(Halfedge h) const;
  template <class Visit>
  void for_each_outgoing(Halfedge h, Visit&& visit) const;

  RepairState& state_;
  std::vector<Halfedge> twin_;
  std::vector<char> alive_;                      // per face
  std::unordered_map<std::uint64_t, int> uses_;  // edges → how many have these vertices
  long alive_count_ = 0;
};

}  // namespace sphparam
