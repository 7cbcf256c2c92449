#include "mesh/handles/handle_cutting.h"

#include "mesh/handles/short_loops.h"
#include "mesh/rim_filling.h"
#include "mesh/triangle_geometry.h"

// A half-edge of the loop has its left face; from there counter-clockwise about its origin, up to
// the half-edge back along the loop, all faces are to the left. Their corners move to the copy.

namespace sphparam {
namespace {

class LoopCutter {
 public:
  LoopCutter(RepairState& state, const Topology& topology, const std::vector<Vertex>& loop)
      : state_(state), topology_(topology), loop_(loop) {}

  void run() {
    for (const Vertex v : loop_) note_faces_about(v);
    for (size_t i = 0; i < loop_.size(); ++i) open_at(i);
    for (const Face f : faces_) {
      for (int k = 0; k < 3; ++k) edges_.insert(state_.faces[f][k], state_.faces[f][(k + 1) % 3]);
    }
    const std::vector<RimVertex> left(left_.rbegin(), left_.rend());
    fill_rim(state_, edges_, right_, true);
    fill_rim(state_, edges_, left, true);
  }

 private:
  void note_faces_about(Vertex v) {
    topology_.for_each_outgoing(v, [&](Halfedge h) { faces_.push_back(Topology::face(h)); });
  }

  void open_at(size_t i) {
    const size_t n = loop_.size();
    const Vertex v = loop_[i];
    const Halfedge on = topology_.find_halfedge(v, loop_[(i + 1) % n]);
    const Halfedge back = topology_.find_halfedge(v, loop_[(i + n - 1) % n]);
    const Vertex copy = state_.copy_vertex(v);
    left_.push_back({copy, state_.corner_like(on)});
    right_.push_back({v, state_.corner_like(Topology::next(topology_.twin(on)))});
    for (Halfedge h = on; h != back; h = topology_.rotate_ccw(h)) {
      state_.faces[Topology::face(h)][Topology::corner(h)] = copy;
    }
  }

  RepairState& state_;
  const Topology& topology_;
  const std::vector<Vertex>& loop_;
  std::vector<Face> faces_;
  EdgeKeys edges_;
  Rim left_, right_;
};

HandleLoop account_of(const RepairState& state, const LoopToCut& loop, double diagonal) {
  HandleLoop account;
  account.filled = loop.filled;
  const size_t n = loop.vertices.size();
  for (const Vertex v : loop.vertices) {
    account.vertices.push_back(state.vertex_origin[v]);
    account.points.push_back(state.positions[v]);
    account.centre += state.positions[v] / static_cast<double>(n);
  }
  const double length = length_of(loop.vertices, state.shape);
  account.length = length * state.scale;
  account.share = diagonal > 0 ? length / diagonal : 0;
  return account;
}

double area_from(const RepairState& state, Face first) {
  double area = 0;
  for (Face f = first; f < state.face_count(); ++f) {
    const auto& [a, b, c] = state.faces[f];
    area += triangle_area(state.shape[a], state.shape[b], state.shape[c]);
  }
  return area * state.scale * state.scale;
}

}  // namespace

void cut_along(RepairState& state, const Topology& topology, const std::vector<LoopToCut>& loops,
               double diagonal) {
  for (const LoopToCut& loop : loops) {
    state.handles.push_back(account_of(state, loop, diagonal));
    const Face first = state.face_count();
    LoopCutter(state, topology, loop.vertices).run();
    state.handles.back().area_added = area_from(state, first);
    state.log(loop.filled ? RepairKind::HandleFilled : RepairKind::HandleCut,
              {state.vertex_origin[loop.vertices.front()]});
  }
}

}  // namespace sphparam
