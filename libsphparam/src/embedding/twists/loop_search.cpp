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
      first_neighbour_(1, 0),
      reached_(at(topology.vertex_count())),
      side_(reached_.size(), 0),
      plain_(reached_.size(), 0) {
  first_neighbour_.reserve(reached_.size() + 1);
  neighbours_.reserve(at(topology.halfedge_count()));
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    topology.for_each_outgoing(v, [&](Halfedge h) { neighbours_.push_back(topology.target(h)); });
    first_neighbour_.push_back(static_cast<int>(neighbours_.size()));
  }
}

std::span<const Vertex> LoopSearch::neighbours(Vertex v) const {
  const int first = first_neighbour_[at(v)], last = first_neighbour_[at(v) + 1];
  return {neighbours_.data() + first, at(last - first)};
}

bool LoopSearch::is_hub(Vertex v) const {
  return first_neighbour_[at(v) + 1] - first_neighbour_[at(v)] > most_valence;
}

VertexLoop LoopSearch::through(Vertex v) {
  if (plain_[at(v)]) return {};
  grow_ball(v);
  VertexLoop found;
  if (ball_is_plain())
    mark_plain();
  else
    found = shortest_loop_in_ball();
  for (const Vertex w : ball_) reached_[at(w)].depth = -1;
  return found;
}

/// Layer by layer, up to the first with a hub in it; no further than loops reach where it does not
/// grow as on a plain surface.
void LoopSearch::grow_ball(Vertex v) {
  ball_.assign(1, v);
  reached_[at(v)].depth = 0;
  layer_ends_.clear();
  hub_at_rim_ = is_hub(v);
  bool plain = true;
  for (size_t i = 0; !hub_at_rim_;) {
    const size_t end = ball_.size();
    layer_ends_.push_back(end);
    plain = plain && static_cast<int>(end - i) >= plain_growth * reach();
    if (reach() >= (plain ? plain_reach : largest_radius)) return;
    for (; i < end; ++i) add_neighbours(ball_[i]);
  }
}

void LoopSearch::add_neighbours(Vertex v) {
  const Reached from = reached_[at(v)];
  for (const Vertex w : neighbours(v)) {
    Reached& to = reached_[at(w)];
    if (to.depth >= 0) continue;
    to = {from.depth + 1, v, from.depth == 0 ? w : from.branch};
    ball_.push_back(w);
    hub_at_rim_ |= is_hub(w);
  }
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
  const auto is_in_ball = [&](Vertex w) { return depth(w) >= 0 && depth(w) <= radius; };
  const size_t count = layer_ends_[at(radius)];
  int edges = 0, corners = 0;
  for (size_t i = 0; i < count; ++i) {
    const std::span<const Vertex> around = neighbours(ball_[i]);
    bool last = is_in_ball(around.back());
    for (const Vertex w : around) {
      const bool inside = is_in_ball(w);
      edges += inside;
      corners += last && inside;
      last = inside;
    }
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
      const Reached &to_a = reached_[at(a)], &to_b = reached_[at(b)];
      if (to_a.depth < 1 || to_b.depth < 1 || to_a.branch == to_b.branch) return;
      const int length = to_a.depth + to_b.depth + 1;
      if (length <= most_edges && a < b) closing.emplace_back(length, h);
    });
  }
  std::ranges::sort(closing);
  return closing;
}

VertexLoop LoopSearch::closed_by(Halfedge h) const {
  VertexLoop loop;
  for (Vertex a = topology_.origin(h); depth(a) > 0; a = reached_[at(a)].parent) loop.push_back(a);
  loop.push_back(ball_.front());
  std::ranges::reverse(loop);
  for (Vertex b = topology_.target(h); depth(b) > 0; b = reached_[at(b)].parent) loop.push_back(b);
  return loop;
}

bool LoopSearch::goes_round(const VertexLoop& loop) {
  return reaches_many(loop, Flank::Left) && reaches_many(loop, Flank::Right);
}

/// Has it more than a few vertices on that flank? A hub is as good as many.
bool LoopSearch::reaches_many(const VertexLoop& loop, Flank flank) {
  for (const Vertex v : loop) side_[at(v)] = 1;
  std::vector<Vertex> seen;
  const auto enter = [&](Vertex v) {
    if (std::exchange(side_[at(v)], 1) == 0) seen.push_back(v);
  };
  for_each_beside(topology_, loop, flank, enter);
  bool hub = false;
  const int least = least_beyond(loop);
  for (size_t i = 0; i < seen.size() && std::ssize(seen) < least; ++i) {
    hub = is_hub(seen[i]);
    if (hub) break;
    for (const Vertex w : neighbours(seen[i])) enter(w);
  }
  for (const Vertex v : loop) side_[at(v)] = 0;
  for (const Vertex v : seen) side_[at(v)] = 0;
  return hub || std::ssize(seen) >= least;
}

}  // namespace sphparam
