#include "mesh/handles/short_loops.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <utility>

#include "sphparam/parallel.h"

// Dijkstra's algorithm about a vertex, with the label of each shortest path: an edge between two
// paths closes a loop, whose label tells whether it separates. The shortest loop that does not
// separate is found from any vertex of it (Erickson & Har-Peled 2004), and crosses the basis.
// Searches go half a loop far and stop: their cost is that of what is small about small handles.

namespace sphparam {
namespace {

constexpr double least_edge = 1e-9;  // added to each edge, in the unit box
// How near to each other searches begin, at the nearest: all vertices where loops are of a few
// edges, for the cost is small and so is what a loop beside them can be tightened.
constexpr double bases_a_length(double reach) { return reach > 12 ? 10 : 24; }
constexpr size_t most_classes = 12;  // that one search tells
constexpr int most_tightenings = 8;
constexpr size_t tried_vertices = 8;  // of a loop, each time
constexpr double least_gain = 1e-9;   // relative; less is rounding

}  // namespace

double length_of(const std::vector<Vertex>& loop, const std::vector<Vector3>& places) {
  double length = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    length += (places[loop[(i + 1) % loop.size()]] - places[loop[i]]).norm();
  }
  return length;
}

/// What waits to be settled, the nearest first. What is far waits unsorted in one of many bins.
class ShortLoops::Queue {
 public:
  void begin(double radius) {
    for (std::vector<Waiting>& bin : bins_) bin.clear();
    near_.clear();
    at_ = 0;
    bins_a_length_ = radius > 0 ? static_cast<double>(bins_.size() - 1) / radius : 0;
  }
  void push(double distance, Vertex v) {
    const size_t bin = std::min(static_cast<size_t>(distance * bins_a_length_), bins_.size() - 1);
    if (bin > at_) return bins_[bin].emplace_back(distance, v), void();
    near_.emplace_back(distance, v);
    std::push_heap(near_.begin(), near_.end(), std::greater<>());
  }
  bool empty() {
    while (near_.empty() && at_ + 1 < bins_.size()) {
      near_.swap(bins_[++at_]);
      std::make_heap(near_.begin(), near_.end(), std::greater<>());
    }
    return near_.empty();
  }
  /// Requires: not empty, as was just asked.
  std::pair<double, Vertex> pop() {
    std::pop_heap(near_.begin(), near_.end(), std::greater<>());
    const Waiting nearest = near_.back();
    near_.pop_back();
    return nearest;
  }

 private:
  using Waiting = std::pair<double, Vertex>;
  std::array<std::vector<Waiting>, 64> bins_;
  std::vector<Waiting> near_;  // a heap
  size_t at_ = 0;              // bins up to here are empty
  double bins_a_length_ = 0;
};

/// What a search writes down, by vertex. Valid where `search` is the present one.
struct ShortLoops::Scratch {
  struct Entry {
    int search = 0;
    bool settled = false;
    Vertex from = -1;
    double distance = 0;
    std::uint64_t label = 0;
  };
  explicit Scratch(size_t vertices) : entries(vertices) {}

  std::vector<Entry> entries;
  int search = 0;
  Queue queue;

  /// Nothing beyond the radius, or hardly anything, is going to be reached.
  void begin(Vertex vertex, double radius) {
    ++search;
    queue.begin(radius);
    reach(vertex, 0, 0, -1);
  }
  bool knows(Vertex v) const { return entries[v].search == search; }
  void reach(Vertex v, double distance, std::uint64_t label, Vertex from) {
    entries[v] = {search, false, from, distance, label};
    queue.push(distance, v);
  }
};

/// A scratch for one search at a time.
class ShortLoops::Lease {
 public:
  explicit Lease(const ShortLoops& owner) : owner_(owner) {
    {
      const std::lock_guard<std::mutex> lock(owner.mutex_);
      if (!owner.idle_.empty()) {
        scratch_ = std::move(owner.idle_.back());
        owner.idle_.pop_back();
      }
    }
    if (!scratch_) scratch_ = std::make_unique<Scratch>(owner.places_.size());
  }
  ~Lease() {
    const std::lock_guard<std::mutex> lock(owner_.mutex_);
    owner_.idle_.push_back(std::move(scratch_));
  }
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;
  Scratch& operator*() const { return *scratch_; }

 private:
  const ShortLoops& owner_;
  std::unique_ptr<Scratch> scratch_;
};

ShortLoops::ShortLoops(const Topology& topology, const LoopBasis& basis,
                       const std::vector<Vector3>& places)
    : basis_(basis), places_(places) {
  list_arcs(topology, places);
  for (const std::vector<Vertex>& loop : basis.loops) {
    loop_lengths_.push_back(length_of(loop, places) +
                            least_edge * static_cast<double>(loop.size()));
  }
  // Leases are given back without a chance to fail.
  idle_.reserve(static_cast<size_t>(resolve_threads(0)) + 1);
}

ShortLoops::~ShortLoops() = default;

void ShortLoops::list_arcs(const Topology& topology, const std::vector<Vector3>& places) {
  first_arc_.assign(places.size() + 1, 0);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) ++first_arc_[topology.origin(h) + 1];
  for (size_t v = 0; v < places.size(); ++v) first_arc_[v + 1] += first_arc_[v];
  std::vector<size_t> next(first_arc_.begin(), first_arc_.end() - 1);
  arcs_.resize(first_arc_.back());
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const Vertex a = topology.origin(h), b = topology.target(h);
    arcs_[next[a]++] = {b, (places[b] - places[a]).norm() + least_edge, basis_.labels[h]};
  }
}

EdgeLoop ShortLoops::closed_by(const Scratch& scratch, const Closing& closing) const {
  const auto way_back = [&](Vertex v) {
    std::vector<Vertex> way;
    for (; v >= 0; v = scratch.entries[v].from) way.push_back(v);
    return way;
  };
  std::vector<Vertex> from = way_back(closing.from), to = way_back(closing.to);
  // They may share their beginnings, which are no part of the loop.
  while (from.size() > 1 && to.size() > 1 && from[from.size() - 2] == to[to.size() - 2]) {
    from.pop_back();
    to.pop_back();
  }
  const double shared = scratch.entries[from.back()].distance;
  EdgeLoop loop = {closing.length - 2 * shared, closing.label, std::move(from)};
  loop.vertices.insert(loop.vertices.end(), to.rbegin() + 1, to.rend());
  return loop;
}

void ShortLoops::keep_shortest(const Closing& found, std::vector<Closing>& of_each_label) {
  for (Closing& known : of_each_label) {
    if (known.label != found.label) continue;
    if (found.length < known.length) known = found;
    return;
  }
  if (of_each_label.size() < most_classes) of_each_label.push_back(found);
}

std::vector<EdgeLoop> ShortLoops::through(Vertex vertex, double longest) const {
  const Lease lease(*this);
  Scratch& scratch = *lease;
  std::vector<Closing> closings;
  scratch.begin(vertex, longest / 2);
  while (!scratch.queue.empty()) {
    const auto [distance, u] = scratch.queue.pop();
    auto& here = scratch.entries[u];
    if (here.settled) continue;
    here.settled = true;
    for (size_t i = first_arc_[u]; i < first_arc_[u + 1]; ++i) {
      const Arc& arc = arcs_[i];
      const auto& there = scratch.entries[arc.target];
      const double length = distance + arc.length;
      const std::uint64_t label = here.label ^ arc.label;
      const bool known = scratch.knows(arc.target);
      if (known && there.settled) {
        if (here.from == arc.target) continue;
        const Closing found{u, arc.target, length + there.distance, label ^ there.label};
        if (found.label != 0 && found.length <= longest) keep_shortest(found, closings);
      } else if (length <= longest / 2 && (!known || length < there.distance)) {
        scratch.reach(arc.target, length, label, u);
      }
    }
  }
  std::vector<EdgeLoop> loops;
  for (const Closing& closing : closings) loops.push_back(closed_by(scratch, closing));
  return loops;
}

std::vector<ShortLoops::Base> ShortLoops::candidates(double reach) const {
  std::vector<Base> result;
  for (size_t i = 0; i < basis_.loops.size(); ++i) {
    const std::vector<Vertex>& loop = basis_.loops[i];
    const double longest = reach * loop_lengths_[i] / static_cast<double>(loop.size());
    double since = longest;
    for (size_t k = 0; k < loop.size(); ++k) {
      if (since * bases_a_length(reach) >= longest) {
        result.push_back({loop[k], longest});
        since = 0;
      }
      since += (places_[loop[(k + 1) % loop.size()]] - places_[loop[k]]).norm() + least_edge;
    }
  }
  return result;
}

void ShortLoops::cover(std::vector<char>& covered, Vertex vertex, double radius) const {
  const Lease lease(*this);
  Scratch& scratch = *lease;
  scratch.begin(vertex, radius);
  while (!scratch.queue.empty()) {
    const auto [distance, u] = scratch.queue.pop();
    if (std::exchange(scratch.entries[u].settled, true)) continue;
    covered[u] = 1;
    for (size_t i = first_arc_[u]; i < first_arc_[u + 1]; ++i) {
      const Vertex v = arcs_[i].target;
      const double length = distance + arcs_[i].length;
      if (length > radius || (scratch.knows(v) && length >= scratch.entries[v].distance)) continue;
      scratch.reach(v, length, 0, u);
    }
  }
}

/// Loops of the basis run beside each other for long: a net of their vertices is enough.
std::vector<ShortLoops::Base> ShortLoops::bases(double reach) const {
  std::vector<Base> wanted = candidates(reach);
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Base& x, const Base& y) { return x.longest > y.longest; });
  std::vector<char> covered(places_.size(), 0);
  std::vector<Base> result;
  for (const Base& base : wanted) {
    if (covered[base.vertex]) continue;
    cover(covered, base.vertex, base.longest / bases_a_length(reach));
    result.push_back(base);
  }
  return result;
}

bool ShortLoops::reaches(double length, double reach) const {
  const double slack =
      bases_a_length(reach) / (bases_a_length(reach) - 3);  // bases are not everywhere
  for (size_t i = 0; i < basis_.loops.size(); ++i) {
    const double mean = loop_lengths_[i] / static_cast<double>(basis_.loops[i].size());
    if (reach * mean < slack * length) return false;
  }
  return true;
}

bool ShortLoops::reaches_all(double reach) const {
  for (const std::vector<Vertex>& loop : basis_.loops) {
    if (reach < 2 * static_cast<double>(loop.size())) return false;
  }
  return true;
}

std::vector<EdgeLoop> ShortLoops::crossing_basis(double reach) const {
  constexpr std::int64_t grain = 16;
  const std::vector<Base> from = bases(reach);
  using Classes = std::map<std::uint64_t, EdgeLoop>;
  const auto keep_shorter = [](Classes& classes, EdgeLoop loop) {
    EdgeLoop& known = classes[loop.label];
    if (known.vertices.empty() || loop.length < known.length) known = std::move(loop);
  };
  const auto count = static_cast<std::int64_t>(from.size());
  std::vector<Classes> found(static_cast<size_t>((count + grain - 1) / grain));
  parallel_for(count, grain, 0, [&](std::int64_t first, std::int64_t last) {
    Classes& here = found[static_cast<size_t>(first / grain)];
    for (std::int64_t i = first; i < last; ++i) {
      const Base& base = from[static_cast<size_t>(i)];
      for (EdgeLoop& loop : through(base.vertex, base.longest)) keep_shorter(here, std::move(loop));
    }
  });
  Classes all;
  for (Classes& classes : found) {
    for (auto& [label, loop] : classes) keep_shorter(all, std::move(loop));
  }
  std::vector<EdgeLoop> loops;
  for (auto& [label, loop] : all) loops.push_back(std::move(loop));
  std::stable_sort(loops.begin(), loops.end(),
                   [](const EdgeLoop& x, const EdgeLoop& y) { return x.length < y.length; });
  return loops;
}

EdgeLoop ShortLoops::tightened(EdgeLoop loop) const {
  for (int round = 0; round < most_tightenings; ++round) {
    EdgeLoop best = loop;
    const size_t size = loop.vertices.size(), tried = std::min(size, tried_vertices);
    for (size_t i = 0; i < tried; ++i) {
      const Vertex vertex = loop.vertices[i * size / tried];
      for (EdgeLoop& other : through(vertex, best.length * (1 - least_gain))) {
        if (other.label == loop.label && other.length < best.length) best = std::move(other);
      }
    }
    if (!(best.length < loop.length)) break;
    loop = std::move(best);
  }
  return loop;
}

}  // namespace sphparam
