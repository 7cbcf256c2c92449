#include <algorithm>
#include <queue>

#include "mesh/face_sides.h"
#include "mesh/repair/rim_filling.h"

// A hole is the cycle of boundary sides, run through backwards. Its ears are cut off, cheapest
// first: an ear that does not turn against the hole's mean normal (Newell's) before one that does,
// then the shortest cut. A cut along an edge that is there already would double it; when only such
// ears are left (never on a surface without handles: the edges outside would cross), a vertex is
// created in the middle and joined to all that remain. Ears wait in a queue: n log n for n edges.

namespace sphparam {
namespace {

class HoleFiller {
 public:
  HoleFiller(RepairState& state, EdgeKeys& edges, const Rim& rim)
      : state_(state), edges_(edges), rim_(rim), ring_(rim.size()), left_(rim.size()) {
    const size_t n = rim.size();
    for (size_t i = 0; i < n; ++i) ring_[i] = {(i + n - 1) % n, (i + 1) % n, 0};
    for (size_t i = 0; i < n; ++i) normal_ += point(i).cross(point((i + 1) % n));
  }

  void fill(bool apart) {
    for (size_t i = 0; i < ring_.size(); ++i) enqueue(i);
    while (left_ > 3 && cut_cheapest_ear()) continue;
    if (left_ == 3 && apart) {
      add_triangle(last_, ring_[last_].next, ring_[last_].previous);
    } else {
      fill_by_fan();
    }
  }

 private:
  struct Link {
    size_t previous, next;
    int changes;  // ears queued before the last change are stale
  };
  struct Ear {
    bool doubles, folded;
    double length;
    size_t at;
    int changes;
    auto order() const { return std::tie(doubles, folded, length, at); }
    bool operator<(const Ear& other) const { return other.order() < order(); }  // cheapest on top
  };

  const Vector3& point(size_t i) const { return state_.shape[rim_[i].vertex]; }

  Ear ear(size_t i) const {
    const auto [before, after, changes] = ring_[i];
    const Vector3 &p = point(before), &q = point(after);
    const bool folded = (point(i) - p).cross(q - p).dot(normal_) < 0;
    const double length = (q - p).squaredNorm();
    const bool doubles = edges_.contains(rim_[before].vertex, rim_[after].vertex);
    return {doubles, folded, length, i, changes};
  }
  void enqueue(size_t i) { ears_.push(ear(i)); }

  bool cut_cheapest_ear() {
    for (;;) {
      const Ear best = ears_.top();
      if (best.doubles && best.changes == ring_[best.at].changes) return false;
      ears_.pop();
      if (best.changes != ring_[best.at].changes) continue;
      if (ear(best.at).doubles) {  // a cut made since then
        enqueue(best.at);
        continue;
      }
      cut(best.at);
      return true;
    }
  }

  void cut(size_t at) {
    const auto [before, after, changes] = ring_[at];
    add_triangle(before, at, after);
    edges_.insert(rim_[before].vertex, rim_[after].vertex);
    ring_[before].next = after;
    ring_[after].previous = before;
    ++ring_[at].changes;
    --left_;
    last_ = before;
    for (const size_t i : {before, after}) {
      ++ring_[i].changes;
      enqueue(i);
    }
  }

  void add_triangle(size_t i, size_t j, size_t k) {
    state_.add_face({rim_[i].vertex, rim_[j].vertex, rim_[k].vertex},
                    {rim_[i].corner_like, rim_[j].corner_like, rim_[k].corner_like});
  }

  void fill_by_fan() {
    std::vector<Vertex> remaining;
    size_t i = last_;
    do {
      remaining.push_back(rim_[i].vertex);
      i = ring_[i].next;
    } while (i != last_);
    const Vertex centre = state_.create_mean(remaining);
    do {
      const size_t j = ring_[i].next;
      state_.add_face({rim_[i].vertex, rim_[j].vertex, centre},
                      {rim_[i].corner_like, rim_[j].corner_like, rim_[i].corner_like});
      edges_.insert(rim_[i].vertex, centre);
      i = j;
    } while (i != last_);
  }

  RepairState& state_;
  EdgeKeys& edges_;
  const Rim& rim_;
  std::vector<Link> ring_;
  size_t left_;
  size_t last_ = 0;  // some vertex that is still there
  Vector3 normal_ = Vector3::Zero();
  std::priority_queue<Ear> ears_;
};

constexpr Halfedge none = -1;
constexpr Halfedge several = -2;

/// Per vertex: the boundary half-edge that ends there.
std::vector<Halfedge> boundary_into(const RepairState& state, const std::vector<FaceSide>& sides) {
  std::vector<Halfedge> into(state.positions.size(), none);
  for_each_edge(sides, [&](size_t i, size_t j) {
    if (j - i != 1) return;
    const Vertex end = sides[i].forward ? sides[i].high : sides[i].low;
    into[end] = into[end] == none ? sides[i].halfedge : several;
  });
  return into;
}

/// The cycle of the hole that starts at the end of a boundary half-edge; empty where boundaries
/// touch or run against each other, so that there is no such cycle.
Rim walk(const RepairState& state, const std::vector<Halfedge>& into, Vertex first,
         std::vector<char>& seen) {
  Rim rim;
  for (Vertex v = first;;) {
    const Halfedge h = into[v];
    if (h < 0 || seen[v]) return {};
    seen[v] = 1;
    rim.push_back({v, state.corner_like(h % 3 == 2 ? h - 2 : h + 1)});
    v = state.corner(h);
    if (v == first) return rim;
  }
}

}  // namespace

void fill_rim(RepairState& state, EdgeKeys& edges, const Rim& rim, bool apart) {
  HoleFiller(state, edges, rim).fill(apart);
}

void fill_holes(RepairState& state, const RepairOptions& options) {
  const std::vector<FaceSide> sides = sorted_sides(state.triangles(), [](Face) { return true; });
  const std::vector<Halfedge> into = boundary_into(state, sides);
  EdgeKeys edges;
  edges.reserve(sides.size());
  for_each_edge(sides, [&](size_t i, size_t) { edges.insert(sides[i].low, sides[i].high); });
  std::vector<char> seen(state.positions.size(), 0);
  state.largest_hole_left = 0;
  const Vertex vertices = state.vertex_count();
  for (Vertex v = 0; v < vertices; ++v) {
    if (into[v] < 0 || seen[v]) continue;
    const Rim rim = walk(state, into, v, seen);
    if (options.keep_holes && rim.size() >= 3) {
      close_by_rings(state, rim, true);
      state.log(RepairKind::HoleKept, {state.vertex_origin[v]});
      continue;
    }
    if (rim.size() > static_cast<size_t>(options.largest_hole)) {
      state.largest_hole_left = std::max(state.largest_hole_left, static_cast<long>(rim.size()));
      continue;
    }
    if (rim.size() < 3) continue;
    const bool one_face = rim.size() == 3 && into[rim[0].vertex] / 3 == into[rim[1].vertex] / 3 &&
                          into[rim[0].vertex] / 3 == into[rim[2].vertex] / 3;
    fill_rim(state, edges, rim, !one_face);
    state.log(RepairKind::HoleFilled, {state.vertex_origin[v]});
  }
}

}  // namespace sphparam
