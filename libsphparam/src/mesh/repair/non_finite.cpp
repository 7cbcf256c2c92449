#include "mesh/repair/repair_state.h"

// A vertex without a place takes its faces with it; the hole is filled by the steps that follow.
// What is left gets its unit box anew, since no box holds NaN. These faces count among those that
// were lost, but no area does: nobody knows theirs.

namespace sphparam {

void remove_non_finite(RepairState& state) {
  const auto is_bad = [&](Vertex v) { return !state.positions[v].allFinite(); };
  std::vector<char> kept(state.faces.size(), 1);
  for (Face f = 0; f < state.face_count(); ++f) {
    for (const Vertex v : state.faces[f])
      if (v >= 0 && v < state.vertex_count() && is_bad(v)) kept[f] = 0;
    if (!kept[f]) state.log(RepairKind::NonFiniteFaceRemoved, {state.face_origin[f]});
  }
  std::vector<char> kept_vertices(state.positions.size(), 1);
  for (Vertex v = 0; v < state.vertex_count(); ++v) {
    if (!is_bad(v)) continue;
    kept_vertices[v] = 0;
    state.log(RepairKind::NonFiniteVertexDropped, {state.vertex_origin[v]});
  }
  const auto all = static_cast<double>(state.face_count());
  state.keep_faces(kept);
  if (all > 0) state.parts.face_share = state.face_count() / all;
  state.keep_vertices(kept_vertices);
  state.measure();
}

}  // namespace sphparam
