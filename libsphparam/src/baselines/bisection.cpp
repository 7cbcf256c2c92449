#include <functional>
#include <queue>
#include <stdexcept>
#include <utility>

#include "baselines/harmless_mesh.h"
#include "mesh/laplace_system.h"
#include "sphparam/baselines/hemispheres.h"
#include "sphparam/mesh/edge_weights.h"

// u is harmonic but for u = 0 and u = 1 at two vertices far from each other; its level sets are
// short where the mesh is thin. One half grows from the face with the least u, face by face in the
// order of u, and only by faces that keep it a disk: by one edge and a vertex that is new to it, or
// by two edges. A face that does not fit now is asked again when a neighbour joins. So the seam is
// one simple path, and the growth stops when half of the faces have joined.

namespace sphparam {
namespace {

/// The last vertex of a breadth-first search, counted in edges.
Vertex farthest(const Topology& topology, Vertex from) {
  std::vector<char> seen(static_cast<size_t>(topology.vertex_count()), 0);
  std::vector<Vertex> queue = {from};
  seen[static_cast<size_t>(from)] = 1;
  for (size_t i = 0; i < queue.size(); ++i) {
    topology.for_each_outgoing(queue[i], [&](Halfedge h) {
      char& mark = seen[static_cast<size_t>(topology.target(h))];
      if (!mark) queue.push_back(topology.target(h));
      mark = 1;
    });
  }
  return queue.back();
}

VectorX harmonic_height(const TriangleMesh& mesh, const Topology& topology, int threads) {
  const Vertex low = farthest(topology, 0), high = farthest(topology, low);
  std::vector<VertexRole> roles(static_cast<size_t>(topology.vertex_count()), VertexRole::Free);
  roles[static_cast<size_t>(low)] = roles[static_cast<size_t>(high)] = VertexRole::Fixed;
  MatrixX values = MatrixX::Zero(topology.vertex_count(), 1);
  values(high, 0) = 1;
  LaplaceSystem system(topology, std::move(roles), true, threads);
  system.factorise(EdgeWeights(mesh, topology, WeightKind::SymmetricMeanValue, threads)
                       .with(topology, {}, threads),
                   threads);
  return system.solve(values, {}, threads);
}

class Growth {
 public:
  Growth(const Topology& topology, const VectorX& height)
      : topology_(topology),
        height_(height),
        joined_(static_cast<size_t>(topology.face_count()), 0),
        touched_(static_cast<size_t>(topology.vertex_count()), 0) {}

  /// joined: 1 per face of the half that has grown.
  std::vector<char> grow() {
    Vertex lowest = 0;
    height_.minCoeff(&lowest);
    join(Topology::face(topology_.outgoing(lowest)));
    for (int count = 1; count < topology_.face_count() / 2;) {
      if (queue_.empty()) throw std::logic_error("a disk of faces that no face can join");
      const Face f = queue_.top().second;
      queue_.pop();
      if (!fits(f)) continue;
      join(f);
      ++count;
    }
    return std::move(joined_);
  }

 private:
  using Entry = std::pair<double, Face>;

  bool is_joined(Face f) const { return joined_[static_cast<size_t>(f)] != 0; }

  bool fits(Face f) const {
    if (is_joined(f)) return false;
    int edges = 0;
    bool apex_touched = false;
    for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
      if (!is_joined(Topology::face(topology_.twin(h)))) continue;
      ++edges;
      apex_touched = touched_[static_cast<size_t>(topology_.apex(h))] != 0;
    }
    return edges == 2 || (edges == 1 && !apex_touched);
  }

  void join(Face f) {
    joined_[static_cast<size_t>(f)] = 1;
    for (int k = 0; k < 3; ++k) {
      const Vertex v = topology_.vertex(f, k);
      touched_[static_cast<size_t>(v)] = 1;
      ask(Topology::face(topology_.twin(3 * f + k)));
    }
  }

  void ask(Face f) {
    if (is_joined(f)) return;
    const double height = height_[topology_.vertex(f, 0)] + height_[topology_.vertex(f, 1)] +
                          height_[topology_.vertex(f, 2)];
    queue_.push({height, f});
  }

  const Topology& topology_;
  const VectorX& height_;
  std::vector<char> joined_, touched_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

Bisection bisect(const TriangleMesh& mesh, const Topology& topology, int threads) {
  const VectorX height = harmonic_height(HarmlessMesh(mesh).mesh, topology, threads);
  const std::vector<char> low = Growth(topology, height).grow();
  Bisection result;
  for (const char joined : low) result.side.push_back(joined ? 1 : 0);
  // Along the seam, side 0 on the left: from each half-edge to the next one around its target.
  const auto on_seam = [&](Halfedge h) {
    return result.side[static_cast<size_t>(Topology::face(h))] == 0 &&
           result.side[static_cast<size_t>(Topology::face(topology.twin(h)))] == 1;
  };
  Halfedge first = 0;
  while (!on_seam(first)) ++first;
  Halfedge h = first;
  do {
    result.seam.push_back(topology.origin(h));
    h = Topology::next(h);
    while (!on_seam(h)) h = topology.rotate_cw(h);
  } while (h != first);
  return result;
}

}  // namespace sphparam
