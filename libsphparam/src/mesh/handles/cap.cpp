#include "mesh/handles/cap.h"

#include <array>
#include <utility>

// Rings of vertices as in a kept hole; then each of these moves to the mean of its neighbours, over
// and over: what soap would do, about. Of several bends the first one that nothing crosses is
// taken, or the one that least does.

namespace sphparam {
namespace {

constexpr int rounds = 40;                                       // of means: rings are few
constexpr std::array bends = {0.25, 0.1, 0.5, 0.03, 1.0, -0.1};  // in mean edges of the rim

class Cap {
 public:
  Cap(RepairState& state, const Rim& rim, const Vector3& own_side)
      : state_(state), first_vertex_(state.vertex_count()), first_face_(state.face_count()) {
    close_by_rings(state, rim, false);
    list_neighbours();
    for (int round = 0; round < rounds; ++round) relax();
    measure(rim, own_side);
  }

  /// The bend that is crossed least, and how often. Moves the vertices there.
  long bend(const SurfaceCells& surface) {
    const std::vector<Vector3> flat = places_;
    long least = -1;
    std::vector<Vector3> best;
    for (const double share : bends) {
      for (size_t i = 0; i < places_.size(); ++i) places_[i] = flat[i] + share * step_;
      const long crossings = count(surface);
      if (least >= 0 && crossings >= least) continue;
      least = crossings;
      best = places_;
      if (least == 0) break;
    }
    places_ = std::move(best);
    settle();
    return least;
  }

 private:
  static size_t at(int i) { return static_cast<size_t>(i); }
  bool is_inner(Vertex v) const { return v >= first_vertex_; }
  const Vector3& place(Vertex v) const {
    return is_inner(v) ? places_[at(v - first_vertex_)] : state_.shape[at(v)];
  }

  void list_neighbours() {
    neighbours_.resize(at(state_.vertex_count() - first_vertex_));
    for (Face f = first_face_; f < state_.face_count(); ++f) {
      for (size_t k = 0; k < 3; ++k) {
        const Vertex v = state_.faces[at(f)][k], next = state_.faces[at(f)][(k + 1) % 3];
        if (is_inner(v)) neighbours_[at(v - first_vertex_)].push_back(next);
      }
    }
    for (Vertex v = first_vertex_; v < state_.vertex_count(); ++v) {
      places_.push_back(state_.shape[at(v)]);
    }
  }

  void relax() {
    for (size_t i = 0; i < places_.size(); ++i) {
      Vector3 sum = Vector3::Zero();
      for (const Vertex v : neighbours_[i]) sum += place(v);
      places_[i] = sum / static_cast<double>(neighbours_[i].size());
    }
  }

  /// One step: a mean edge of the rim along its normal, to the side that is closed.
  void measure(const Rim& rim, const Vector3& own_side) {
    Vector3 normal = Vector3::Zero();
    double length = 0;
    const Vector3& origin = state_.shape[at(rim[0].vertex)];
    for (size_t i = 0; i < rim.size(); ++i) {
      const Vector3 a = state_.shape[at(rim[i].vertex)] - origin,
                    b = state_.shape[at(rim[(i + 1) % rim.size()].vertex)] - origin;
      normal += a.cross(b);
      length += (b - a).norm();
    }
    const double size = normal.norm(), edge = length / static_cast<double>(rim.size());
    if (size > 0) step_ = (normal.dot(own_side) < 0 ? -edge : edge) / size * normal;
  }

  long count(const SurfaceCells& surface) const {
    long crossings = 0;
    for (Face f = first_face_; f < state_.face_count(); ++f) {
      const auto& [a, b, c] = state_.faces[at(f)];
      crossings += surface.crossings({place(a), place(b), place(c)});
    }
    return crossings;
  }

  void settle() {
    for (size_t i = 0; i < places_.size(); ++i) {
      const size_t v = at(first_vertex_) + i;
      state_.positions[v] += state_.scale * (places_[i] - state_.shape[v]);
      state_.shape[v] = places_[i];
    }
  }

  RepairState& state_;
  const Vertex first_vertex_;
  const Face first_face_;
  std::vector<std::vector<Vertex>> neighbours_;  // of inner vertices
  std::vector<Vector3> places_;                  // theirs
  Vector3 step_ = Vector3::Zero();
};

}  // namespace

long close_by_cap(RepairState& state, const Rim& rim, const Vector3& own_side,
                  const SurfaceCells& surface) {
  return Cap(state, rim, own_side).bend(surface);
}

}  // namespace sphparam
