#pragma once

#include <span>
#include <utility>
#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// A closed path of edges: its vertices in order.
using VertexLoop = std::vector<Vertex>;

/// Of a loop, as its vertices run.
enum class Flank { Left, Right };

/// Finds loops of a few edges that go round limbs. Our own.
class LoopSearch {
 public:
  /// Edges of a loop; with more around few twists stay.
  static constexpr int most_around = 12;

  /// Requires: the topology outlives it.
  explicit LoopSearch(const Topology& topology);

  /// A shortest loop through v that has more than a few vertices on its left, and on its right.
  /// Empty: there is none, or a hub is near, or the surface about v is as plain as a plane.
  /// Cost: that of the vertices within a few edges of v; nothing near a v that was found plain.
  VertexLoop through(Vertex v);

  /// Has it more edges than are looked at again and again? No loop goes there.
  bool is_hub(Vertex v) const;

 private:
  void grow_ball(Vertex v);
  void add_neighbours(Vertex v);
  int reach() const;
  bool ball_is_plain() const;
  void mark_plain();
  bool ball_is_disk(int radius) const;
  VertexLoop shortest_loop_in_ball();
  VertexLoop shortest_loop(int most_edges);
  std::vector<std::pair<int, Halfedge>> closing_edges(int most_edges) const;
  VertexLoop closed_by(Halfedge h) const;
  bool goes_round(const VertexLoop& loop);
  bool reaches_many(const VertexLoop& loop, Flank flank);

  /// How a vertex was reached from the middle of the ball.
  struct Reached {
    int depth = -1;  // −1: not in the ball
    Vertex parent = -1, branch = -1;
  };

  std::span<const Vertex> neighbours(Vertex v) const;
  int depth(Vertex v) const { return reached_[static_cast<size_t>(v)].depth; }

  const Topology& topology_;
  std::vector<int> first_neighbour_;
  std::vector<Vertex> neighbours_;  // of all: half-edges of a mesh at large are far apart in memory
  std::vector<Reached> reached_;
  std::vector<char> side_;  // 0 between uses
  std::vector<char> plain_;
  std::vector<Vertex> ball_;
  bool hub_at_rim_ = false;
  std::vector<size_t> layer_ends_;  // in the ball, of those without hubs
};

/// Visits the vertices next to a loop on one flank, one after the other.
template <class Visit>
void for_each_beside(const Topology& topology, const VertexLoop& loop, Flank flank,
                     const Visit& visit) {
  const size_t n = loop.size();
  for (size_t i = 0; i < n; ++i) {
    const Vertex next = loop[(i + 1) % n], previous = loop[(i + n - 1) % n];
    const auto [from, to] =
        flank == Flank::Left ? std::pair(next, previous) : std::pair(previous, next);
    Halfedge h = topology.rotate_ccw(topology.find_halfedge(loop[i], from));
    for (; topology.target(h) != to; h = topology.rotate_ccw(h)) visit(topology.target(h));
  }
}

}  // namespace sphparam
