#include "embedding/twists/loop_search.h"

#include <algorithm>
#include <array>

// A ball grows about the vertex, by breadth. Where it is no disk, it reaches round something: an
// edge between two of its branches closes a loop through the vertex, which is as short as any.

namespace sphparam {
namespace {

constexpr int ball_radius = LoopSearch::most_around / 2;
constexpr int plain_radius = 2,
              plain_growth = 3;   // a layer of a plane has 6 vertices more than the one before
constexpr int most_valence = 16;  // of vertices in loops
constexpr int least_beyond = 8;   // vertices on either side of a loop

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
  VertexLoop found;
  if (plain_[at(v)] || is_plain_about(v)) return found;
  if (grow_ball(v, ball_radius) && !ball_is_disk()) found = shortest_loop();
  forget_ball();
  return found;
}

/// Where a larger ball grows as on a plain surface, no vertex near its middle has such a loop.
bool LoopSearch::is_plain_about(Vertex v) {
  constexpr int radius = ball_radius + plain_radius;
  bool plain = grow_ball(v, radius);
  std::array<int, radius + 1> layers{};
  for (const Vertex w : ball_) ++layers[at(depth_[at(w)])];
  for (int d = 1; d <= radius; ++d) plain = plain && layers[at(d)] >= plain_growth * d;
  for (size_t i = 0; plain && i < ball_.size() && depth_[at(ball_[i])] <= plain_radius; ++i) {
    plain_[at(ball_[i])] = 1;
  }
  forget_ball();
  return plain;
}

void LoopSearch::forget_ball() {
  for (const Vertex w : ball_) depth_[at(w)] = -1;
}

/// False: there is a hub in it.
bool LoopSearch::grow_ball(Vertex v, int radius) {
  ball_.assign(1, v);
  depth_[at(v)] = 0;
  for (size_t i = 0; i < ball_.size(); ++i) {
    const Vertex w = ball_[i];
    if (is_hub(w)) return false;
    if (depth_[at(w)] == radius) continue;
    topology_.for_each_outgoing(w, [&](Halfedge h) {
      const Vertex x = topology_.target(h);
      if (depth_[at(x)] >= 0) return;
      depth_[at(x)] = depth_[at(w)] + 1;
      parent_[at(x)] = w;
      branch_[at(x)] = w == v ? x : branch_[at(w)];
      ball_.push_back(x);
    });
  }
  return true;
}

/// By the numbers of its vertices, edges and triangles.
bool LoopSearch::ball_is_disk() const {
  int edges = 0, corners = 0;
  for (const Vertex w : ball_) {
    topology_.for_each_outgoing(w, [&](Halfedge h) {
      if (depth_[at(topology_.target(h))] < 0) return;
      ++edges;
      corners += depth_[at(topology_.apex(h))] >= 0;
    });
  }
  return static_cast<int>(ball_.size()) - edges / 2 + corners / 3 == 1;
}

VertexLoop LoopSearch::shortest_loop() {
  for (const auto& [length, h] : closing_edges()) {
    VertexLoop loop = closed_by(h);
    if (goes_round(loop)) return loop;
  }
  return {};
}

/// Edges between two branches, with the lengths of their loops, short ones first.
std::vector<std::pair<int, Halfedge>> LoopSearch::closing_edges() const {
  std::vector<std::pair<int, Halfedge>> closing;
  for (const Vertex a : ball_) {
    topology_.for_each_outgoing(a, [&](Halfedge h) {
      const Vertex b = topology_.target(h);
      if (depth_[at(a)] < 1 || depth_[at(b)] < 1 || branch_[at(a)] == branch_[at(b)]) return;
      const int length = depth_[at(a)] + depth_[at(b)] + 1;
      if (length <= most_around && a < b) closing.emplace_back(length, h);
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
  for (size_t i = 0; i < seen.size() && std::ssize(seen) < least_beyond; ++i) {
    hub = is_hub(seen[i]);
    if (hub) break;
    topology_.for_each_outgoing(seen[i], [&](Halfedge h) { enter(topology_.target(h)); });
  }
  for (const Vertex v : loop) side_[at(v)] = 0;
  for (const Vertex v : seen) side_[at(v)] = 0;
  return hub || std::ssize(seen) >= least_beyond;
}

}  // namespace sphparam
