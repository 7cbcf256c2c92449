#include "embedding/twists/loop_search.h"

#include <algorithm>

// A ball grows about the vertex, by breadth. Where it is no disk, it reaches round something: an
// edge between two of its branches closes a loop through the vertex, which is as short as any.

namespace sphparam {
namespace {

constexpr int largest_radius = LoopSearch::most_around / 2;
constexpr int plain_radius = 4, plain_reach = largest_radius + plain_radius;
constexpr int plain_growth = 3;   // a layer of a plane has 6 vertices more than the one before
constexpr int most_valence = 16;  // of vertices in loops

/// Vertices on either side of a loop: on a plain surface it may have some two thirds as many.
int least_beyond(const VertexLoop& loop) {
  const int around = static_cast<int>(loop.size());
  return std::max(8, around * around / 8);
}

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

LoopSearch::LoopSearch(const Topology& topology)
    : topology_(topology),
      depth_(at(topology.vertex_count()), -1),
      parent_(depth_.size(), -1),
      branch_(depth_.size(), -1),
      side_(depth_.size(), 0),
      plain_(depth_.size(), 0),
      valence_(depth_.size(), 0) {
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) ++valence_[at(topology.origin(h))];
}

bool LoopSearch::is_hub(Vertex v) const { return valence_[at(v)] > most_valence; }

VertexLoop LoopSearch::through(Vertex v) {
  if (plain_[at(v)]) return {};
  grow_ball(v);
  VertexLoop found;
  if (ball_is_plain())
    mark_plain();
  else
    found = shortest_loop_in_ball();
  for (const Vertex w : ball_) depth_[at(w)] = -1;
  return found;
}

/// Layer by layer, up to the first with a hub in it; no further than loops reach where it does not
/// grow as on a plain surface.
void LoopSearch::grow_ball(Vertex v) {
  ball_.assign(1, v);
  depth_[at(v)] = 0;
  layer_ends_.clear();
  bool plain = true;
  for (size_t i = 0;;) {
    const size_t end = ball_.size();
    if (std::any_of(ball_.begin() + static_cast<long>(i), ball_.end(),
                    [&](Vertex w) { return is_hub(w); }))
      return;
    layer_ends_.push_back(end);
    plain = plain && static_cast<int>(end - i) >= plain_growth * reach();
    if (reach() >= (plain ? plain_reach : largest_radius)) return;
    for (; i < end; ++i) add_neighbours(ball_[i]);
  }
}

void LoopSearch::add_neighbours(Vertex v) {
  topology_.for_each_outgoing(v, [&](Halfedge h) {
    const Vertex w = topology_.target(h);
    if (depth_[at(w)] >= 0) return;
    depth_[at(w)] = depth_[at(v)] + 1;
    parent_[at(w)] = v;
    branch_[at(w)] = depth_[at(v)] == 0 ? w : branch_[at(v)];
    ball_.push_back(w);
  });
}

/// Edges from the middle of the ball to the last whole layer.
int LoopSearch::reach() const { return static_cast<int>(layer_ends_.size()) - 1; }

/// Where a larger ball grows as on a plain surface, no vertex near its middle has a loop.
bool LoopSearch::ball_is_plain() const { return reach() >= plain_reach; }

void LoopSearch::mark_plain() {
  for (size_t i = 0; i < layer_ends_[plain_radius]; ++i) plain_[at(ball_[i])] = 1;
}

/// As far as this radius: by the numbers of its vertices, edges and triangles.
bool LoopSearch::ball_is_disk(int radius) const {
  const auto is_in_ball = [&](Vertex w) { return depth_[at(w)] >= 0 && depth_[at(w)] <= radius; };
  const size_t count = layer_ends_[at(radius)];
  int edges = 0, corners = 0;
  for (size_t i = 0; i < count; ++i) {
    topology_.for_each_outgoing(ball_[i], [&](Halfedge h) {
      if (!is_in_ball(topology_.target(h))) return;
      ++edges;
      corners += is_in_ball(topology_.apex(h));
    });
  }
  return static_cast<int>(count) - edges / 2 + corners / 3 == 1;
}

/// A large ball swallows short limbs whole: a smaller one is tried first, and what it could have
/// found elsewhere is no loop of the larger one.
VertexLoop LoopSearch::shortest_loop_in_ball() {
  int shorter = 0;
  for (const int radius : {largest_radius - 2, largest_radius}) {
    if (radius > reach()) break;
    VertexLoop loop;
    if (!ball_is_disk(radius)) loop = shortest_loop(2 * radius);
    if (std::ssize(loop) > shorter) return loop;
    shorter = 2 * radius;
  }
  return {};
}

VertexLoop LoopSearch::shortest_loop(int most_edges) {
  for (const auto& [length, h] : closing_edges(most_edges)) {
    VertexLoop loop = closed_by(h);
    if (goes_round(loop)) return loop;
  }
  return {};
}

/// Edges between two branches, with the lengths of their loops, short ones first. Those beyond the
/// last whole layer, where hubs may be, are too long.
std::vector<std::pair<int, Halfedge>> LoopSearch::closing_edges(int most_edges) const {
  std::vector<std::pair<int, Halfedge>> closing;
  for (size_t i = 0; i < layer_ends_.back(); ++i) {
    const Vertex a = ball_[i];
    topology_.for_each_outgoing(a, [&](Halfedge h) {
      const Vertex b = topology_.target(h);
      if (depth_[at(a)] < 1 || depth_[at(b)] < 1 || branch_[at(a)] == branch_[at(b)]) return;
      const int length = depth_[at(a)] + depth_[at(b)] + 1;
      if (length <= most_edges && a < b) closing.emplace_back(length, h);
    });
  }
  std::ranges::sort(closing);
  return closing;
}

VertexLoop LoopSearch::closed_by(Halfedge h) const {
  VertexLoop loop;
  for (Vertex a = topology_.origin(h); depth_[at(a)] > 0; a = parent_[at(a)]) loop.push_back(a);
  loop.push_back(ball_.front());
  std::ranges::reverse(loop);
  for (Vertex b = topology_.target(h); depth_[at(b)] > 0; b = parent_[at(b)]) loop.push_back(b);
  return loop;
}

bool LoopSearch::goes_round(const VertexLoop& loop) {
  return reaches_many(loop, true) && reaches_many(loop, false);
}

/// Has it more than a few vertices on that side? A hub is as good as many.
bool LoopSearch::reaches_many(const VertexLoop& loop, bool left) {
  for (const Vertex v : loop) side_[at(v)] = 1;
  std::vector<Vertex> seen;
  const auto enter = [&](Vertex v) {
    if (std::exchange(side_[at(v)], 1) == 0) seen.push_back(v);
  };
  for_each_beside(topology_, loop, left, enter);
  bool hub = false;
  const int least = least_beyond(loop);
  for (size_t i = 0; i < seen.size() && std::ssize(seen) < least; ++i) {
    hub = is_hub(seen[i]);
    if (hub) break;
    topology_.for_each_outgoing(seen[i], [&](Halfedge h) { enter(topology_.target(h)); });
  }
  for (const Vertex v : loop) side_[at(v)] = 0;
  for (const Vertex v : seen) side_[at(v)] = 0;
  return hub || std::ssize(seen) >= least;
}

}  // namespace sphparam
