#include "embedding/constructions/planar_drawing.h"

// The drawing is taken down from the top. Its contour runs from the left root to the right one; a
// vertex v between them without a chord to the contour is removed, with its remaining faces
// (v, left, right), left to right. That makes three trees (Schnyder's wood), rooted in the corners
// of the outer face, and labels the corners of every face:
//   parents of v: 0 its left, 1 its right neighbour on the contour, 2 the vertex whose removal
//   exposed it; corners: `left` has label 0, `right` label 1, v label 2.
// Region i of v lies between its paths to the two other roots. A face belongs to it exactly if its
// corner labelled i hangs, in tree i, below a vertex of these paths; below one only. With Sᵢ(u) the
// weight of all corners labelled i in u's subtree of tree i,
//   weight of region i = Σ Sᵢ over one path + Σ Sᵢ over the other − Sᵢ(v).
// Parents 0 and 1 are removed after v, parent 2 before it: all sums are runs over that order.

namespace sphparam {
namespace {

using Weight = std::int64_t;

size_t at(int i) { return static_cast<size_t>(i); }

/// Trees, subtree weights and order of removal.
class Wood {
 public:
  Wood(const Topology& topology, Face outer, const std::vector<Weight>& weights)
      : topology_(topology),
        weights_(weights),
        left_root_(topology.vertex(outer, 0)),
        right_root_(topology.vertex(outer, 2)),
        top_(topology.vertex(outer, 1)),
        vertices_(at(topology.vertex_count())) {
    left_root().edge = 3 * outer;
    top().edge = 3 * outer + 1;
    top().left = left_root_;
    right_root().left = top_;
    left_root().on_contour = right_root().on_contour = top().on_contour = true;
    free_ = {top_};
    for (size_t i = 0; i < free_.size(); ++i) {  // first come, first removed: trees stay shallow
      const Vertex v = free_[i];
      if (of(v).on_contour && of(v).chords == 0) remove(v);
    }
    top().parent[0] = top().parent[1] = -1;
  }

  PlanarDrawing draw(Weight total) {
    // Path sums: S₀ and S₁ to root 2 in order of removal, S₁ to root 0 and S₀ to root 1 against it.
    PlanarDrawing drawing{PlanarDrawing::Coordinates::Zero(topology_.vertex_count(), 3), total};
    std::vector<Weight> to_top0(vertices_.size(), 0), to_top1 = to_top0, to_left = to_top0,
                                                      to_right = to_top0;
    for (const Vertex v : removed_) {
      const Vertex up = of(v).parent[2];
      if (up < 0) continue;
      to_top0[at(v)] = of(v).subtree[0] + to_top0[at(up)];
      to_top1[at(v)] = of(v).subtree[1] + to_top1[at(up)];
    }
    for (size_t i = removed_.size(); i-- > 1;) {  // removed_[0] is the top
      const Vertex v = removed_[i];
      const Node& node = of(v);
      to_right[at(v)] = node.subtree[0] + to_right[at(node.parent[1])];
      to_left[at(v)] = node.subtree[1] + to_left[at(node.parent[0])];
      const Weight first = to_right[at(v)] + to_top0[at(v)] - node.subtree[0];
      const Weight second = to_left[at(v)] + to_top1[at(v)] - node.subtree[1];
      drawing.coordinates.row(v) << first, second, total - first - second;
    }
    drawing.coordinates(left_root_, 0) = total;
    drawing.coordinates(right_root_, 1) = total;
    drawing.coordinates(top_, 2) = total;
    return drawing;
  }

 private:
  struct Node {
    Weight subtree[2] = {0, 0};
    Vertex parent[3] = {-1, -1, -1};
    Vertex left = -1;    // on the contour
    Halfedge edge = -1;  // to the right on the contour; its face is removed
    int chords = 0;      // to vertices of the contour that are not next to it
    bool on_contour = false;
  };

  Node& of(Vertex v) { return vertices_[at(v)]; }
  Node& left_root() { return of(left_root_); }
  Node& right_root() { return of(right_root_); }
  Node& top() { return of(top_); }
  Vertex right_of(Vertex v) { return topology_.target(of(v).edge); }

  void remove(Vertex v) {
    const Vertex left = of(v).left, right = right_of(v);
    exposed_.clear();
    Vertex last = left;
    for (Halfedge h = topology_.twin(of(left).edge); last != right; h = topology_.rotate_ccw(h)) {
      const Vertex next = topology_.apex(h);
      const Weight weight = weights_[at(Topology::face(h))];
      of(last).subtree[0] += weight;
      of(next).subtree[1] += weight;
      of(last).edge = Topology::next(h);
      of(next).left = last;
      if (next != right) {
        of(next).parent[2] = v;
        exposed_.push_back(next);
      }
      last = next;
    }
    hang(v, left, right);
    if (exposed_.empty()) {
      lose_chord(left);  // left–right was one, and is an edge of the contour now
      lose_chord(right);
    }
    for (const Vertex w : exposed_) enter_contour(w);
    for (const Vertex w : exposed_) {
      if (of(w).chords == 0) free_.push_back(w);
    }
  }

  void hang(Vertex v, Vertex left, Vertex right) {
    Node& node = of(v);
    node.on_contour = false;
    node.parent[0] = left;
    node.parent[1] = right;
    of(left).subtree[0] += node.subtree[0];
    of(right).subtree[1] += node.subtree[1];
    removed_.push_back(v);
  }

  bool is_root(Vertex v) const { return v == left_root_ || v == right_root_; }

  void lose_chord(Vertex v) {
    if (--of(v).chords == 0 && !is_root(v)) free_.push_back(v);
  }

  void enter_contour(Vertex w) {
    topology_.for_each_outgoing(w, [&](Halfedge h) {
      const Vertex u = topology_.target(h);
      if (!of(u).on_contour || u == of(w).left || u == right_of(w)) return;
      ++of(u).chords;
      ++of(w).chords;
    });
    of(w).on_contour = true;
  }

  const Topology& topology_;
  const std::vector<Weight>& weights_;
  const Vertex left_root_, right_root_, top_;
  std::vector<Node> vertices_;
  std::vector<Vertex> free_;  // may be removed, if still on the contour and without a chord
  std::vector<Vertex> exposed_;
  std::vector<Vertex> removed_;  // in this order
};

}  // namespace

PlanarDrawing draw_inside(const Topology& topology, Face outer,
                          const std::vector<std::int64_t>& weights) {
  Weight total = 0;
  for (Face f = 0; f < topology.face_count(); ++f) {
    if (f != outer) total += weights[at(f)];
  }
  return Wood(topology, outer, weights).draw(total);
}

}  // namespace sphparam
