#include "mesh/handles/loop_basis.h"

#include "mesh/union_find.h"

// The tree is by breadth; the cotree takes the edges that are far from its roots first, so that
// those left over close short loops (Erickson & Whittlesey 2005). A random number is drawn for each
// edge left over; tree edges have 0, and those of the cotree what makes the sum about each face 0:
// the labels are 64 random cocycles, and sums of them vanish on what bounds.

namespace sphparam {
namespace {

class BasisBuilder {
 public:
  explicit BasisBuilder(const Topology& topology)
      : topology_(topology),
        parent_(static_cast<size_t>(topology.vertex_count()), none),
        level_(parent_.size(), -1) {}

  LoopBasis run() {
    grow_tree();
    if (handles() == 0) return {};
    grow_cotree();
    LoopBasis basis;
    basis.labels = labels();
    for (const Halfedge h : generators_) basis.loops.push_back(loop_through(h));
    return basis;
  }

 private:
  static constexpr Halfedge none = -1;

  bool is_tree_edge(Halfedge h) const {
    return parent_[topology_.target(h)] == h || parent_[topology_.origin(h)] == topology_.twin(h);
  }

  void grow_tree() {
    for (Vertex root = 0; root < topology_.vertex_count(); ++root) {
      if (topology_.outgoing(root) == none || level_[root] >= 0) continue;
      ++components_;
      level_[root] = 0;
      std::vector<Vertex> queue = {root};
      for (size_t i = 0; i < queue.size(); ++i) {
        topology_.for_each_outgoing(queue[i], [&](Halfedge h) {
          const Vertex v = topology_.target(h);
          if (level_[v] >= 0) return;
          level_[v] = level_[queue[i]] + 1;
          parent_[v] = h;
          queue.push_back(v);
        });
      }
      used_ += static_cast<long>(queue.size());
    }
  }

  long handles() const {
    return (2 * components_ - (used_ - topology_.edge_count() + topology_.face_count())) / 2;
  }

  /// The edges outside of the tree, those far from the roots first.
  std::vector<Halfedge> edges_by_level() const {
    const auto distance = [&](Halfedge h) {
      return level_[topology_.origin(h)] + level_[topology_.target(h)];
    };
    const auto wanted = [&](Halfedge h) { return h < topology_.twin(h) && !is_tree_edge(h); };
    std::vector<size_t> first(2 * level_.size() + 2, 0);
    for (Halfedge h = 0; h < topology_.halfedge_count(); ++h) {
      if (wanted(h)) ++first[distance(h)];
    }
    size_t total = 0;
    for (auto count = first.rbegin(); count != first.rend(); ++count) {
      total += *count;
      *count = total - *count;
    }
    std::vector<Halfedge> edges(total);
    for (Halfedge h = 0; h < topology_.halfedge_count(); ++h) {
      if (wanted(h)) edges[first[distance(h)]++] = h;
    }
    return edges;
  }

  void grow_cotree() {
    crossed_.assign(static_cast<size_t>(topology_.halfedge_count()), 0);
    UnionFind faces(static_cast<size_t>(topology_.face_count()));
    for (const Halfedge h : edges_by_level()) {
      const Halfedge t = topology_.twin(h);
      if (faces.unite(Topology::face(h), Topology::face(t))) {
        crossed_[h] = crossed_[t] = 1;
      } else {
        generators_.push_back(h);
      }
    }
  }

  /// A face's half-edge towards the root of the cotree, or none; and the faces, roots first.
  std::pair<std::vector<Halfedge>, std::vector<Face>> rooted_cotree() const {
    std::vector<Halfedge> up(static_cast<size_t>(topology_.face_count()), none);
    std::vector<char> seen(up.size(), 0);
    std::vector<Face> order;
    order.reserve(up.size());
    for (Face root = 0; root < topology_.face_count(); ++root) {
      if (seen[root]) continue;
      seen[root] = 1;
      order.push_back(root);
      for (size_t i = order.size() - 1; i < order.size(); ++i) {
        for (Halfedge h = 3 * order[i]; h < 3 * order[i] + 3; ++h) {
          const Halfedge t = topology_.twin(h);
          if (!crossed_[h] || seen[Topology::face(t)]) continue;
          seen[Topology::face(t)] = 1;
          up[Topology::face(t)] = t;
          order.push_back(Topology::face(t));
        }
      }
    }
    return {std::move(up), std::move(order)};
  }

  /// The i-th of a fixed sequence of random numbers (Steele, Lea & Flood 2014, splitmix64).
  static std::uint64_t random_number(std::uint64_t i) {
    std::uint64_t z = (i + 1) * 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::vector<std::uint64_t> labels() const {
    std::vector<std::uint64_t> label(crossed_.size(), 0);
    for (size_t i = 0; i < generators_.size(); ++i) {
      const Halfedge h = generators_[i];
      label[h] = label[topology_.twin(h)] = random_number(i);
    }
    const auto [up, order] = rooted_cotree();
    for (auto face = order.rbegin(); face != order.rend(); ++face) {
      const Halfedge h = up[*face];
      if (h == none) continue;
      label[h] = label[topology_.twin(h)] = label[Topology::next(h)] ^ label[Topology::previous(h)];
    }
    return label;
  }

  /// The edge and the ways up the tree from its ends, to where they meet.
  std::vector<Vertex> loop_through(Halfedge h) const {
    Vertex a = topology_.origin(h), b = topology_.target(h);
    std::vector<Vertex> from_a = {a}, from_b = {b};
    while (a != b) {
      const bool climb_a = level_[a] >= level_[b];
      Vertex& v = climb_a ? a : b;
      v = topology_.origin(parent_[v]);
      (climb_a ? from_a : from_b).push_back(v);
    }
    from_b.pop_back();  // where they meet is named once
    from_a.insert(from_a.end(), from_b.rbegin(), from_b.rend());
    return from_a;
  }

  const Topology& topology_;
  std::vector<Halfedge> parent_;  // of the tree: the half-edge that ends at a vertex
  std::vector<int> level_;
  long components_ = 0, used_ = 0;
  std::vector<char> crossed_;  // half-edges whose dual is in the cotree
  std::vector<Halfedge> generators_;
};

}  // namespace

LoopBasis loop_basis(const Topology& topology) { return BasisBuilder(topology).run(); }

}  // namespace sphparam
