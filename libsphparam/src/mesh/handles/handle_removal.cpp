#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <unordered_set>
#include <utility>

#include "mesh/handles/handle_cutting.h"
#include "mesh/handles/loop_side.h"
#include "mesh/handles/short_loops.h"
#include "mesh/repair/repair_state.h"
#include "mesh/triangle_geometry.h"
#include "mesh/union_find.h"
#include "sphparam/parallel.h"

// Rounds: of the short loops that are found, the shortest first, those are taken that have no
// vertex in common and, together, separate nothing: their labels are independent. Cutting them
// makes a new surface with as many handles less, and a new basis. Where nothing is found the reach
// is doubled. What is taken does not depend on the limit, which only ends it: a handle that is
// refused for a loop of some length goes when that length is allowed.

namespace sphparam {
namespace {

constexpr double first_reach = 12;  // edges

/// Of loops without common vertices, shortest first, those that together separate nothing: all
/// loops leave pieces, which stay connected across the longest that can be spared.
std::vector<EdgeLoop> not_separating(const Topology& topology, std::vector<EdgeLoop> loops) {
  std::vector<char> is_cut(static_cast<size_t>(topology.halfedge_count()), 0);
  std::vector<Halfedge> on_loop;
  for (const EdgeLoop& loop : loops) {
    for (size_t i = 0; i < loop.vertices.size(); ++i) {
      const Vertex next = loop.vertices[(i + 1) % loop.vertices.size()];
      const Halfedge h = topology.find_halfedge(loop.vertices[i], next);
      is_cut[h] = is_cut[topology.twin(h)] = 1;
      if (i == 0) on_loop.push_back(h);
    }
  }
  UnionFind pieces(static_cast<size_t>(topology.face_count()));
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    if (!is_cut[h]) pieces.unite(Topology::face(h), Topology::face(topology.twin(h)));
  }
  std::vector<EdgeLoop> kept;
  for (size_t i = loops.size(); i-- > 0;) {
    const Halfedge h = on_loop[i];
    const bool connects = pieces.unite(Topology::face(h), Topology::face(topology.twin(h)));
    if (!connects) kept.push_back(std::move(loops[i]));
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

/// What is asked of the part of the surface that a vertex is in.
struct OfParts {
  std::vector<char> inside_out;  // #V
  std::vector<double> diagonal;  // #V, of the box about those of its first vertices
  double longest_diagonal = 0;
};

/// A handle is large or small beside the part that it belongs to: what else is in the file, and how
/// far off, says nothing of it. Of boxes the first `vertices` alone: caps, which come later, change
/// none.
OfParts parts_of(const RepairState& state, Vertex vertices) {
  const size_t count = state.positions.size();
  UnionFind parts(count);
  for (const auto& [a, b, c] : state.faces) {
    parts.unite(a, b);
    parts.unite(b, c);
  }
  std::vector<double> volume(count, 0);
  const Vector3 none = Vector3::Constant(std::numeric_limits<double>::infinity());
  std::vector<Vector3> lower(count, none), upper(count, -none);
  for (const auto& face : state.faces) {
    const auto& [a, b, c] = face;
    const auto part = static_cast<size_t>(parts.find(a));
    volume[part] += state.shape[a].dot(state.shape[b].cross(state.shape[c]));
    for (const Vertex v : face) {
      if (v >= vertices) continue;
      lower[part] = lower[part].cwiseMin(state.shape[v]);
      upper[part] = upper[part].cwiseMax(state.shape[v]);
    }
  }
  OfParts result{std::vector<char>(count), std::vector<double>(count, 0)};
  for (size_t v = 0; v < count; ++v) {
    const auto part = static_cast<size_t>(parts.find(static_cast<Vertex>(v)));
    result.inside_out[v] = volume[part] < 0;
    if (!(lower[part].x() <= upper[part].x())) continue;  // no face names it
    result.diagonal[v] = (upper[part] - lower[part]).norm();
    result.longest_diagonal = std::max(result.longest_diagonal, result.diagonal[v]);
  }
  return result;
}

/// Where the vertices are, for lengths: what only fillers use is far off, so that loops go round a
/// hole and not across it.
std::vector<Vector3> places_off_fillers(const RepairState& state) {
  constexpr double far_off = 8;               // a few diagonals of the unit box
  std::vector<Vector3> places = state.shape;  // which grows while the surface is cut
  std::vector<char> on_surface(places.size(), 0);
  for (Face f = 0; f < state.face_count(); ++f) {
    if (state.fillers[f]) continue;
    for (const Vertex v : state.faces[f]) on_surface[v] = 1;
  }
  for (size_t v = 0; v < places.size(); ++v) {
    if (!on_surface[v]) places[v].z() += far_off;
  }
  return places;
}

class HandleRemover {
 public:
  HandleRemover(RepairState& state, const RepairOptions& options)
      : state_(state),
        choice_(options.handle_choice),
        longest_share_(options.longest_handle),
        longest_length_(options.longest_handle_length / state.scale),
        first_vertices_(state.vertex_count()) {}

  void run() {
    while (const std::optional<Topology> topology =
               Topology::try_build(state_.triangles(), state_.vertex_count())) {
      const LoopBasis basis = loop_basis(*topology);
      if (basis.loops.empty() || !cut_some(*topology, basis)) return;
    }
  }

 private:
  bool cut_some(const Topology& topology, const LoopBasis& basis) {
    const std::vector<Vector3> places = places_off_fillers(state_);
    const ShortLoops search(topology, basis, places);
    of_parts_ = parts_of(state_, first_vertices_);
    const double any_limit = limit_for(of_parts_.longest_diagonal);
    double shortest = std::numeric_limits<double>::infinity();  // in diagonals of its part
    for (;; reach_ *= 2) {
      const std::vector<EdgeLoop> found = chosen(topology, search);
      std::vector<LoopToCut> allowed;
      for (const EdgeLoop& loop : found) {
        const double length = length_of(loop.vertices, places);
        const double diagonal = of_parts_.diagonal[loop.vertices.front()];
        shortest = std::min(shortest, length / diagonal);
        if (length <= limit_for(diagonal))
          allowed.push_back({loop.vertices, fills(topology, loop), diagonal});
      }
      if (!allowed.empty()) {
        cut_along(state_, topology, allowed);
        return true;
      }
      const bool beyond_limit = std::isfinite(shortest) && search.reaches(any_limit, reach_);
      if (!beyond_limit && !search.reaches_all(reach_)) continue;
      if (!std::isfinite(shortest) && !std::exchange(any_kind_, true)) continue;
      if (std::isfinite(shortest)) state_.shortest_handle_left = shortest;
      return false;
    }
  }

  double limit_for(double diagonal) const {
    return longest_length_ > 0 ? longest_length_ : longest_share_ * diagonal;
  }

  bool fills(const Topology& topology, const EdgeLoop& loop) const {
    return spans_outside(topology, state_.shape, loop.vertices) !=
           (of_parts_.inside_out[loop.vertices.front()] != 0);
  }
  bool is_wanted(const Topology& topology, const EdgeLoop& loop) const {
    return any_kind_ || choice_ == HandleChoice::Shortest || choice_ == HandleChoice::Area ||
           fills(topology, loop) == (choice_ == HandleChoice::Fill);
  }

  /// What the choice makes least: the length, or about the area of a cap.
  double cost_of(const EdgeLoop& loop) const {
    if (choice_ != HandleChoice::Area) return loop.length;
    const size_t n = loop.vertices.size();
    Vector3 middle = Vector3::Zero();
    for (const Vertex v : loop.vertices) middle += state_.shape[v] / static_cast<double>(n);
    double area = 0;
    for (size_t i = 0; i < n; ++i) {
      area += triangle_area(middle, state_.shape[loop.vertices[i]],
                            state_.shape[loop.vertices[(i + 1) % n]]);
    }
    return area;
  }

  /// Loops of the kind that is wanted, the best first, without common vertices. One that touches
  /// those taken waits for the next round, and so do loops that would stand for it until then: of
  /// its class, or of its class and theirs.
  std::vector<EdgeLoop> apart(const Topology& topology, std::vector<EdgeLoop> loops) const {
    std::stable_sort(loops.begin(), loops.end(),
                     [&](const EdgeLoop& x, const EdgeLoop& y) { return cost_of(x) < cost_of(y); });
    std::vector<int> taken_by(state_.positions.size(), -1);
    std::unordered_set<std::uint64_t> waiting;  // classes
    std::vector<EdgeLoop> result;
    for (EdgeLoop& loop : loops) {
      if (!is_wanted(topology, loop)) continue;
      const std::set<int> touched = touched_by(loop, taken_by);
      if (!touched.empty()) {
        for (const std::uint64_t label : sums(loop, touched, result)) waiting.insert(label);
      } else if (!waiting.contains(loop.label)) {
        for (const Vertex v : loop.vertices) taken_by[v] = static_cast<int>(result.size());
        result.push_back(std::move(loop));
      }
    }
    return result;
  }

  static std::set<int> touched_by(const EdgeLoop& loop, const std::vector<int>& taken_by) {
    std::set<int> touched;
    for (const Vertex v : loop.vertices) {
      if (taken_by[v] >= 0) touched.insert(taken_by[v]);
    }
    return touched;
  }

  /// The class of a loop and of its sums with some of those that it touches.
  static std::vector<std::uint64_t> sums(const EdgeLoop& loop, const std::set<int>& touched,
                                         const std::vector<EdgeLoop>& taken) {
    constexpr size_t most_sums = 64;
    std::vector<std::uint64_t> labels = {loop.label};
    for (const int i : touched) {
      const size_t count = labels.size();
      if (2 * count > most_sums) break;
      for (size_t k = 0; k < count; ++k) {
        labels.push_back(labels[k] ^ taken[static_cast<size_t>(i)].label);
      }
    }
    return labels;
  }

  std::vector<EdgeLoop> chosen(const Topology& topology, const ShortLoops& search) const {
    std::vector<EdgeLoop> loops =
        not_separating(topology, apart(topology, search.crossing_basis(reach_)));
    parallel_for(static_cast<std::int64_t>(loops.size()), 1, 0,
                 [&](std::int64_t first, std::int64_t last) {
                   for (std::int64_t i = first; i < last; ++i) {
                     EdgeLoop& loop = loops[static_cast<size_t>(i)];
                     loop = search.tightened(std::move(loop));
                   }
                 });
    return apart(topology, std::move(loops));  // of the same classes: they separate nothing
  }

  RepairState& state_;
  const HandleChoice choice_;
  const double longest_share_, longest_length_;
  const Vertex first_vertices_;
  double reach_ = first_reach;
  bool any_kind_ = false;  // of the kind that is wanted no loop was found: crumpled ones have none
  OfParts of_parts_;
};

}  // namespace

void remove_handles(RepairState& state, const RepairOptions& options) {
  state.shortest_handle_left = 0;
  if (state.face_count() >= 4) HandleRemover(state, options).run();
}

}  // namespace sphparam
