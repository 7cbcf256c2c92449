#include "mesh/handles/handle_cutting.h"

#include "mesh/handles/cap.h"
#include "mesh/handles/short_loops.h"
#include "mesh/handles/surface_cells.h"
#include "mesh/triangle_geometry.h"

// A half-edge of the loop has its left face; from there counter-clockwise about its origin, up to
// the half-edge back along the loop, all faces are to the left. Their corners move to the copy.

namespace sphparam {
namespace {

class LoopCutter {
 public:
  LoopCutter(RepairState& state, const Topology& topology, const std::vector<Vertex>& loop,
             const SurfaceCells& surface)
      : state_(state), topology_(topology), loop_(loop), surface_(surface) {}

  /// Returns how often the caps pass through the surface.
  long run() {
    for (size_t i = 0; i < loop_.size(); ++i) open_at(i);
    const std::vector<RimVertex> left(left_.rbegin(), left_.rend());
    const long of_right = close_by_cap(state_, right_, into_right_, surface_);
    return of_right + close_by_cap(state_, left, into_left_, surface_);
  }

 private:
  void open_at(size_t i) {
    const size_t n = loop_.size();
    const Vertex v = loop_[i];
    const Halfedge on = topology_.find_halfedge(v, loop_[(i + 1) % n]);
    const Halfedge back = topology_.find_halfedge(v, loop_[(i + n - 1) % n]);
    into_left_ += from_side(on);
    into_right_ += from_side(topology_.twin(on));
    const Vertex copy = state_.copy_vertex(v);
    left_.push_back({copy, state_.corner_like(on)});
    right_.push_back({v, state_.corner_like(Topology::next(topology_.twin(on)))});
    for (Halfedge h = on; h != back; h = topology_.rotate_ccw(h)) {
      state_.faces[Topology::face(h)][Topology::corner(h)] = copy;
    }
  }

  /// From the middle of a side to the corner opposite.
  Vector3 from_side(Halfedge h) const {
    const std::vector<Vector3>& places = state_.shape;
    return places[topology_.apex(h)] -
           (places[topology_.origin(h)] + places[topology_.target(h)]) / 2;
  }

  RepairState& state_;
  const Topology& topology_;
  const std::vector<Vertex>& loop_;
  const SurfaceCells& surface_;
  Rim left_, right_;
  Vector3 into_left_ = Vector3::Zero(), into_right_ = Vector3::Zero();
};

HandleLoop account_of(const RepairState& state, const LoopToCut& loop) {
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
  account.share = loop.diagonal > 0 ? length / loop.diagonal : 0;
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

void cut_along(RepairState& state, const Topology& topology, const std::vector<LoopToCut>& loops) {
  const SurfaceCells surface(state);
  for (const LoopToCut& loop : loops) {
    state.handles.push_back(account_of(state, loop));
    const Face first = state.face_count();
    const long crossings = LoopCutter(state, topology, loop.vertices, surface).run();
    state.handles.back().crossings = crossings;
    state.handles.back().area_added = area_from(state, first);
    state.log(loop.filled ? RepairKind::HandleFilled : RepairKind::HandleCut,
              {state.vertex_origin[loop.vertices.front()]});
  }
}

}  // namespace sphparam
