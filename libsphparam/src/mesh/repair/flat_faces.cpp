#include <algorithm>
#include <optional>

#include "mesh/flat_face.h"
#include "mesh/repair/paired_faces.h"
#include "mesh/repair/repair_state.h"
#include "sphparam/mesh/topology.h"

// A flat face with two vertices at one place loses the edge between them, if the surface stays what
// it is. Any other has a vertex on its longest edge; that edge is turned about to end there, if
// this leaves fewer flat faces and folds nothing. Positions never change. What neither helps stays:
// the map does not mind. Fillers may be as flat as they like.

namespace sphparam {
namespace {

class FlatFaceMender {
 public:
  FlatFaceMender(RepairState& state, std::vector<Halfedge> twin)
      : state_(state), faces_(state, std::move(twin)) {}

  void run() {
    // What one action frees another may need: go round until nothing happens, at most so often.
    constexpr int most_rounds = 8;
    for (int round = 0; round < most_rounds; ++round) {
      bool any = false;
      for (Face f = 0; f < state_.face_count(); ++f) {
        if (faces_.is_alive(f) && !state_.fillers[f] && is_flat_face(f) && (collapse(f) || turn(f)))
          any = true;
      }
      if (!any) break;
    }
    faces_.finish();
  }

 private:
  const Vector3& point(Vertex v) const { return state_.shape[v]; }
  const Vector3& origin(Halfedge h) const { return point(faces_.origin(h)); }

  bool is_flat_face(Face f) const {
    return is_flat(faces_.origin(3 * f), faces_.origin(3 * f + 1), faces_.origin(3 * f + 2));
  }
  bool is_flat(Vertex a, Vertex b, Vertex c) const {
    return has_no_area(state_.positions[a], state_.positions[b], state_.positions[c]);
  }

  bool collapse(Face f) {
    for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) {
      const Vertex a = faces_.origin(h), b = faces_.target(h);
      if (state_.positions[a] != state_.positions[b] || !faces_.can_collapse(h)) continue;
      const Vertex kept = faces_.collapse(h);
      state_.log(RepairKind::FlatFaceCollapsed, {state_.vertex_origin[kept == a ? b : a]});
      return true;
    }
    return false;
  }

  bool turn(Face f) {
    Halfedge longest = 3 * f;
    for (const Halfedge h : {3 * f + 1, 3 * f + 2}) {
      if (length(h) > length(longest)) longest = h;
    }
    if (!faces_.can_turn(longest)) return false;
    const Halfedge other = faces_.twin(longest);
    if (state_.fillers[other / 3]) return false;
    const Vertex from = faces_.origin(longest), to = faces_.origin(other),
                 apex = faces_.apex(longest), across = faces_.apex(other);
    const Vector3 &a = point(from), &b = point(to), &c = point(apex), &d = point(across);
    const Vector3 normal = (b - a).cross(c - a) + (a - b).cross(d - b);
    const bool folds = (d - a).cross(c - a).dot(normal) < 0 || (b - d).cross(c - d).dot(normal) < 0;
    const int flat_before = 1 + is_flat_face(other / 3);
    const int flat_after = is_flat(from, across, apex) + is_flat(across, to, apex);
    if (folds || flat_after >= flat_before) return false;
    state_.log(RepairKind::FlatFaceTurned, {state_.face_origin[f]});
    split_other(longest);
    return true;
  }

  /// What lies beside a flat face is cut at the face's vertex: both halves are pieces of it.
  void split_other(Halfedge h) {
    const Halfedge t = faces_.twin(h);
    const Vector3 edge = origin(t) - origin(h), to = point(faces_.apex(h)) - origin(h);
    const int like_a = state_.corner_like(PairedFaces::next(t)), like_b = state_.corner_like(t),
              like_d = state_.corner_like(PairedFaces::previous(t));
    const double length = edge.squaredNorm();
    const double share = length > 0 ? std::clamp(to.dot(edge) / length, 0.0, 1.0) : 0;
    const int like_c = state_.blend(like_a, like_b, share);
    faces_.turn(h);
    state_.corner_origin[h / 3] = {like_a, like_d, like_c};
    state_.corner_origin[t / 3] = {like_d, like_b, like_c};
    state_.face_origin[h / 3] = state_.face_origin[t / 3];
  }

  double length(Halfedge h) const {
    return (origin(PairedFaces::next(h)) - origin(h)).squaredNorm();
  }

  RepairState& state_;
  PairedFaces faces_;
};

/// Some are, and some are not: where all are, there is no shape to keep, and nothing that one
/// could be better than another for.
bool is_flat_in_part(const RepairState& state) {
  long flat = 0, others = 0;
  for (Face f = 0; f < state.face_count(); ++f) {
    const auto& [a, b, c] = state.faces[f];
    if (state.fillers[f]) continue;
    has_no_area(state.positions[a], state.positions[b], state.positions[c]) ? ++flat : ++others;
  }
  return flat > 0 && others > 0;
}

}  // namespace

void mend_flat_faces(RepairState& state) {
  if (state.face_count() < 4 || !is_flat_in_part(state)) return;
  const std::optional<Topology> topology =
      Topology::try_build(state.triangles(), state.vertex_count());
  if (!topology) return;
  std::vector<Halfedge> twin(state.faces.size() * 3);
  for (Halfedge h = 0; h < static_cast<Halfedge>(twin.size()); ++h) twin[h] = topology->twin(h);
  FlatFaceMender(state, std::move(twin)).run();
}

}  // namespace sphparam
