#include "mesh/mesh_hierarchy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "mesh/triangle_geometry.h"
#include "sphparam/parallel.h"

// One batch: (1) every vertex v prices its cheapest half-edge collapse v → u: squared edge length
// times penalties for valences that grow; (2) vertices are ordered by price, to 5 bits of mantissa;
// (3) greedily, cheap vertices are removed that no removed neighbour has locked, if the link
// condition holds: v and u have exactly two common neighbours, in the mesh as it is after the
// batch's earlier collapses; (4) the survivors' rings are spliced. Only step (3) is serial.
//
// A legal collapse always exists: a triangulation with more than four vertices has a vertex of
// valence at most five, and one of its edges is in no separating triangle (Euler; Whitney).

namespace sphparam {
namespace {

constexpr std::int64_t grain = 256;
constexpr int largest_removed_valence = 24;  // rings that are placed later stay small
constexpr double candidates = 0.7;    // the share of vertices, cheapest first, a batch looks at
constexpr double short_edge = 1e-3;   // of the mean: shorter ones are priced by valences
constexpr double least_area = 1e-18;  // of the squared extent: less is none
constexpr int attempts = 6;           // targets tried for one vertex before it is left alone

size_t at(int i) { return static_cast<size_t>(i); }

/// Removal of a vertex of this valence: low valences are easier to put back.
double removal_penalty(int valence) {
  const double excess = std::max(0, valence - 6), penalty = 1 + 0.1 * excess * excess;
  return penalty * penalty;
}

/// A collapse that leaves its target with this valence.
double target_penalty(int valence) {
  const double excess = std::max(0, valence - 7), penalty = 1 + 0.15 * excess * excess;
  return penalty * penalty;
}

/// Its buffers serve one level after the other.
class Batch {
 public:
  explicit Batch(int threads) : threads_(threads) {}

  /// The next coarser level. Notes in the given one what was removed.
  HierarchyLevel run(HierarchyLevel& level, const std::vector<Vertex>& keep) {
    fine_ = &level;
    count_ = level.vertex_count();
    least_square_ = short_edge * short_edge * 4 * std::numbers::pi / count_;
    price(keep);
    order();
    select();
    if (removed_ == 0 && !keep.empty()) return run(level, {});
    if (removed_ == 0) throw std::logic_error("mesh hierarchy: no vertex can be removed");
    return splice();
  }

 private:
  struct Collapse {
    int slot = -1;  // of the target in the ring
    double cost = std::numeric_limits<double>::infinity();
  };
  /// An edge that a collapse of this batch makes, in a list per vertex.
  struct NewEdge {
    Vertex other;
    int next;
  };

  /// The ring of a vertex; indices may run past the end once.
  struct Ring {
    const Vertex* first;
    int valence;

    Vertex operator[](int i) const { return first[i < valence ? i : i - valence]; }
  };
  Ring ring(Vertex v) const { return {fine_->ring_begin(v), fine_->valence(v)}; }

  /// The cheapest collapse of v among targets not yet tried.
  Collapse cheapest(Vertex v, std::uint32_t tried) const {
    Collapse best;
    const Ring neighbours = ring(v);
    const double* p = fine_->positions.data() + 3 * static_cast<std::ptrdiff_t>(v);
    for (int i = 0; i < neighbours.valence; ++i) {
      if (tried >> i & 1) continue;
      const Vertex u = neighbours.first[i];
      const double* q = fine_->positions.data() + 3 * static_cast<std::ptrdiff_t>(u);
      const double x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
      const double cost = (x * x + y * y + z * z + least_square_) *
                          target_penalty(fine_->valence(u) + neighbours.valence - 4);
      const bool better = best.slot < 0 || cost < best.cost;
      best.slot = better ? i : best.slot;
      best.cost = better ? cost : best.cost;
    }
    best.cost *= removal_penalty(neighbours.valence);
    return best;
  }

  void price(const std::vector<Vertex>& keep) {
    cost_.resize(at(count_));
    slot_.resize(at(count_));
    live_valence_.resize(at(count_));
    first_new_edge_.resize(at(count_));
    name_.resize(at(count_));
    parallel_for(count_, grain, threads_, [&](std::int64_t first, std::int64_t last) {
      for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v) {
        const bool removable = fine_->valence(v) <= largest_removed_valence;
        const Collapse collapse = removable ? cheapest(v, 0) : Collapse{};
        cost_[at(v)] = static_cast<float>(collapse.cost);
        slot_[at(v)] = static_cast<std::int8_t>(collapse.slot);
        live_valence_[at(v)] = fine_->valence(v);
        first_new_edge_[at(v)] = -1;
        name_[at(v)] = free;
      }
    });
    for (const Vertex v : keep) {
      cost_[at(v)] = std::numeric_limits<float>::infinity();
      slot_[at(v)] = -1;
    }
  }

  /// Counting sort on the top 14 bits of the price; a float ≥ 0 sorts like its bits.
  void order() {
    const auto key = [&](Vertex v) { return std::bit_cast<std::uint32_t>(cost_[at(v)]) >> 18; };
    std::vector<int> place(1 << 14, 0);
    for (Vertex v = 0; v < count_; ++v) ++place[key(v)];
    int sum = 0;
    for (int& p : place) {
      const int bucket_size = p;
      p = sum;
      sum += bucket_size;
    }
    order_.resize(at(count_));
    for (Vertex v = 0; v < count_; ++v) order_[at(place[key(v)]++)] = v;
  }

  bool has_new_edge(Vertex a, Vertex b) const {
    for (int e = first_new_edge_[at(a)]; e >= 0; e = new_edges_[at(e)].next) {
      if (new_edges_[at(e)].other == b) return true;
    }
    return false;
  }

  /// Whether an edge a–b exists after the collapses so far. Old edges die only with removed
  /// vertices, which neither is. A long ring is not searched: nothing is quadratic in a valence.
  bool adjacent(Vertex a, Vertex b) const {
    if (fine_->valence(a) > largest_removed_valence && fine_->valence(a) > fine_->valence(b)) {
      std::swap(a, b);
    }
    const Ring neighbours = ring(a);
    for (int i = 0; i < neighbours.valence; ++i) {
      if (neighbours.first[i] == b) return true;
    }
    return has_new_edge(a, b);
  }

  /// The link condition, and no valence may fall below three.
  bool is_legal(Vertex v, int slot) const {
    const Ring around = ring(v);
    const int k = around.valence;
    const Vertex u = around[slot];
    if (live_valence_[at(u)] + k - 4 < 3) return false;
    if (live_valence_[at(around[slot + 1])] <= 3) return false;
    if (live_valence_[at(around[slot + k - 1])] <= 3) return false;
    for (int i = 2; i < k - 1; ++i) {
      if (adjacent(u, around[slot + i])) return false;
    }
    return true;
  }

  int legal_slot(Vertex v) const {
    int slot = slot_[at(v)];
    std::uint32_t tried = 0;
    for (int attempt = 0; attempt < attempts && slot >= 0; ++attempt) {
      if (is_legal(v, slot)) return slot;
      tried |= 1u << slot;
      slot = cheapest(v, tried).slot;
    }
    return -1;
  }

  void add_new_edge(Vertex a, Vertex b) {
    new_edges_.push_back({b, first_new_edge_[at(a)]});
    first_new_edge_[at(a)] = static_cast<int>(new_edges_.size()) - 1;
  }

  void remove(Vertex v, int slot) {
    const Ring around = ring(v);
    const int k = around.valence;
    const Vertex u = around[slot];
    slot_[at(v)] = static_cast<std::int8_t>(slot);
    name_[at(v)] = removed_to(u);
    for (int i = 0; i < k; ++i) name_[at(around.first[i])] = locked;
    live_valence_[at(u)] += k - 4;
    --live_valence_[at(around[slot + 1])];
    --live_valence_[at(around[slot + k - 1])];
    for (int i = 2; i < k - 1; ++i) {
      add_new_edge(u, around[slot + i]);
      add_new_edge(around[slot + i], u);
    }
    ++removed_;
  }

  void select() {
    new_edges_.clear();
    removed_ = 0;
    const int look_at = std::max(8, static_cast<int>(candidates * count_));
    for (int i = 0; i < count_ && count_ - removed_ > 4; ++i) {
      if (i >= look_at && removed_ > 0) break;
      const Vertex v = order_[at(i)];
      if (name_[at(v)] != free || slot_[at(v)] < 0) continue;
      const int slot = legal_slot(v);
      if (slot >= 0) remove(v, slot);
    }
  }

  HierarchyLevel splice() {
    HierarchyLevel coarse;
    const int survivors = count_ - removed_;
    coarse.finer.resize(at(survivors));
    coarse.start.resize(at(survivors) + 1);
    fine_->removed.reserve(at(removed_));
    int next = 0;
    coarse.start[0] = 0;
    for (Vertex v = 0; v < count_; ++v) {
      if (name_[at(v)] < 0) {
        fine_->removed.push_back(v);
        continue;
      }
      name_[at(v)] = next;
      coarse.finer[at(next)] = v;
      coarse.start[at(next) + 1] = coarse.start[at(next)] + live_valence_[at(v)];
      ++next;
    }
    coarse.ring.resize(at(coarse.start.back()));
    coarse.positions.resize(survivors, 3);
    parallel_for(survivors, grain, threads_, [&](std::int64_t first, std::int64_t last) {
      for (auto c = static_cast<Vertex>(first); c < static_cast<Vertex>(last); ++c) {
        const Vertex v = coarse.finer[at(c)];
        coarse.positions.row(c) = fine_->positions.row(v);
        splice_ring(v, coarse.ring.data() + coarse.start[at(c)]);
      }
    });
    keep_removed_positions();
    return coarse;
  }

  void keep_removed_positions() {
    Points kept(removed_, 3);
    for (int i = 0; i < removed_; ++i) {
      kept.row(i) = fine_->positions.row(fine_->removed[at(i)]);
    }
    fine_->positions = std::move(kept);
  }

  void splice_ring(Vertex v, Vertex* out) const {
    const Ring around = ring(v);
    for (int i = 0; i < around.valence; ++i) {
      const Vertex x = around.first[i], name = name_[at(x)];
      if (name >= 0) {
        *out++ = name;
      } else if (name == removed_to(v)) {
        // x's ring takes its place, without the two neighbours we have already.
        const Ring lost = ring(x);
        const int slot = slot_[at(x)];
        for (int j = 2; j < lost.valence - 1; ++j) *out++ = name_[at(lost[slot + j])];
      } else if (removed_to(around[i + 1]) != name &&
                 removed_to(around[i + around.valence - 1]) != name) {
        *out++ = name_[at(removed_to(name))];
      }  // else v is one of the two common neighbours: the edges v–x and v–u become one
    }
  }

  /// What becomes of a vertex: not known yet; stays; −1 − u: collapses into u. In the end, for
  /// those that stay, the name on the coarser level.
  static constexpr Vertex free = 0, locked = 1;
  static constexpr Vertex removed_to(Vertex u) { return -1 - u; }  // its own inverse

  const int threads_;
  HierarchyLevel* fine_ = nullptr;
  int count_ = 0, removed_ = 0;
  double least_square_ = 0;  // added to squared lengths
  std::vector<float> cost_;
  std::vector<std::int8_t> slot_;  // of the collapse's target
  std::vector<Vertex> order_;
  std::vector<Vertex> name_;
  std::vector<int> live_valence_;
  std::vector<int> first_new_edge_;
  std::vector<NewEdge> new_edges_;
};

/// Centred, and scaled to area 4π without overflow or underflow on the way.
Points scaled_positions(const TriangleMesh& mesh, int threads) {
  const Vector3 lower = mesh.positions.colwise().minCoeff();
  const Vector3 upper = mesh.positions.colwise().maxCoeff();
  const Vector3 centre = 0.5 * lower + 0.5 * upper;
  const double extent = 2 * (0.5 * upper - 0.5 * lower).maxCoeff();
  if (!(extent > 0)) return Points::Zero(mesh.vertex_count(), 3);  // all in one place
  Points points(mesh.vertex_count(), 3);
  const auto place = [&](Vertex v) { return Vector3((mesh.position(v) - centre) / extent); };
  const double area =
      parallel_sum(mesh.face_count(), threads, [&](std::int64_t f0, std::int64_t f1) {
        double sum = 0;
        for (std::int64_t f = f0; f < f1; ++f) {
          sum += triangle_area(place(mesh.triangles(f, 0)), place(mesh.triangles(f, 1)),
                               place(mesh.triangles(f, 2)));
        }
        return sum;
      });
  // A mesh without area (all points on a line, or nearly) keeps its unit extent.
  const double scale = area > least_area ? std::sqrt(4 * std::numbers::pi / area) : 1;
  parallel_for(mesh.vertex_count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v) {
      points.row(v) = scale * place(v);
    }
  });
  return points;
}

HierarchyLevel finest_level(const TriangleMesh& mesh, const Topology& topology, int threads) {
  HierarchyLevel level;
  const int n = topology.vertex_count();
  level.positions = scaled_positions(mesh, threads);
  level.start.assign(at(n) + 1, 0);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h)
    ++level.start[at(topology.origin(h)) + 1];
  for (int v = 0; v < n; ++v) level.start[at(v) + 1] += level.start[at(v)];
  level.ring.resize(at(topology.halfedge_count()));
  parallel_for(n, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v) {
      Vertex* out = level.ring.data() + level.start[at(v)];
      topology.for_each_outgoing(v, [&](Halfedge h) { *out++ = topology.target(h); });
    }
  });
  return level;
}

}  // namespace

MeshHierarchy build_hierarchy(const TriangleMesh& mesh, const Topology& topology, int threads,
                              const KeptVertices& keep, const Progress& progress) {
  MeshHierarchy hierarchy;
  hierarchy.push_back(finest_level(mesh, topology, threads));
  std::vector<Vertex> kept = keep.vertices;
  Batch batch(threads);
  while (hierarchy.back().vertex_count() > 4) {
    if (hierarchy.back().vertex_count() <= keep.until) kept.clear();
    HierarchyLevel coarser = batch.run(hierarchy.back(), kept);
    for (Vertex& v : kept) v = coarser_name(coarser, v);
    std::erase(kept, -1);
    hierarchy.push_back(std::move(coarser));
    report(progress, "hierarchy",
           1 - static_cast<double>(hierarchy.back().vertex_count()) / topology.vertex_count());
  }
  return hierarchy;
}

void complete_positions(HierarchyLevel& level, const HierarchyLevel& coarser, int threads) {
  Points all(level.vertex_count(), 3);
  parallel_for(std::ssize(level.removed), grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (std::int64_t i = first; i < last; ++i) {
                   all.row(level.removed[static_cast<size_t>(i)]) = level.positions.row(i);
                 }
               });
  parallel_for(coarser.vertex_count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v) {
      all.row(coarser.finer[at(v)]) = coarser.positions.row(v);
    }
  });
  level.positions = std::move(all);
}

Vertex coarser_name(const HierarchyLevel& coarser, Vertex v) {
  const auto found = std::lower_bound(coarser.finer.begin(), coarser.finer.end(), v);
  if (found == coarser.finer.end() || *found != v) return -1;
  return static_cast<Vertex>(found - coarser.finer.begin());
}

TriangleMesh triangle_mesh(const HierarchyLevel& level) {
  TriangleMesh mesh;
  mesh.positions = level.positions;
  mesh.triangles.resize(2 * level.vertex_count() - 4, 3);
  Eigen::Index f = 0;
  for (Vertex v = 0; v < level.vertex_count(); ++v) {
    const Vertex* ring = level.ring_begin(v);
    const int k = level.valence(v);
    for (int i = 0; i < k; ++i) {
      const Vertex p = ring[i], q = ring[i + 1 < k ? i + 1 : 0];
      if (v < p && v < q) mesh.triangles.row(f++) << v, p, q;  // named by its least corner
    }
  }
  return mesh;
}

}  // namespace sphparam
