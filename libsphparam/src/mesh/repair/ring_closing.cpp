#include <algorithm>
#include <utility>

#include "mesh/repair/rim_filling.h"

// A ring's vertices are means of neighbours of the ring before, drawn towards the middle of the
// rim. Spaces double from ring to ring, and so do the steps inwards: with radius 1 at the rim and K
// rings, ring k lies at 1 − (2ᵏ − 1)/(2ᴷ⁺¹ − 1). Triangles are about as wide as they are high, and
// a boundary of any shape becomes a cone that smooths itself on the way in.

namespace sphparam {
namespace {

constexpr size_t fan_size = 8;  // vertices that the one in the middle is joined to, at most

class RingCloser {
 public:
  RingCloser(RepairState& state, Rim rim)
      : state_(state), ring_(std::move(rim)), middle_(middle_of(ring_)) {
    for (size_t n = ring_.size(); n > fan_size; n = (n + 1) / 2) steps_ = 2 * steps_ + 1;
  }

  void run() {
    double done = 0;  // steps of all
    for (double step = 1; ring_.size() > fan_size; step *= 2) {
      const double left = steps_ - done;
      add_ring(step / left);
      done += step;
    }
    add_fan();
  }

 private:
  struct Middle {
    Vector3 position, place;
  };

  Middle middle_of(const Rim& rim) const {
    Middle middle{Vector3::Zero(), Vector3::Zero()};
    const double share = 1 / static_cast<double>(rim.size());
    for (const RimVertex& v : rim) {
      middle.position += share * state_.positions[v.vertex];
      middle.place += share * state_.shape[v.vertex];
    }
    return middle;
  }

  void add_face(const RimVertex& a, const RimVertex& b, const RimVertex& c) {
    state_.add_face({a.vertex, b.vertex, c.vertex}, {a.corner_like, b.corner_like, c.corner_like});
  }

  /// As many as there are on the rim: attributes of a filler are as good as any.
  static void thin_out(std::vector<WeighedVertex>& origins) {
    constexpr size_t kept = 3;
    if (origins.size() <= kept) return;
    for (size_t i = 0; i < kept; ++i) origins[i] = origins[i * origins.size() / kept];
    origins.resize(kept);
  }

  /// A vertex between neighbours of the ring, `inwards` of the way from there to the middle.
  RimVertex inner(size_t from, double inwards) {
    const size_t n = ring_.size();
    std::vector<Vertex> parents;
    for (size_t i = from; i < std::min(from + 3, n + 1); ++i)
      parents.push_back(ring_[i % n].vertex);
    const Vertex v = state_.create_mean(parents);
    thin_out(state_.mean_of[v]);
    state_.positions[v] += inwards * (middle_.position - state_.positions[v]);
    state_.shape[v] += inwards * (middle_.place - state_.shape[v]);
    return {v, ring_[from].corner_like};
  }

  void add_ring(double inwards) {
    const size_t n = ring_.size();
    Rim next;
    for (size_t i = 0; i < n; i += 2) next.push_back(inner(i, inwards));
    for (size_t j = 0; j < next.size(); ++j) {
      const size_t i = 2 * j, end = std::min(i + 2, n);
      for (size_t k = i; k < end; ++k) add_face(ring_[k], ring_[(k + 1) % n], next[j]);
      add_face(ring_[end % n], next[(j + 1) % next.size()], next[j]);
    }
    ring_ = std::move(next);
  }

  void add_fan() {
    std::vector<Vertex> parents;
    for (const RimVertex& v : ring_) parents.push_back(v.vertex);
    const RimVertex centre{state_.create_mean(parents), ring_.front().corner_like};
    for (size_t i = 0; i < ring_.size(); ++i) {
      add_face(ring_[i], ring_[(i + 1) % ring_.size()], centre);
    }
  }

  RepairState& state_;
  Rim ring_;
  const Middle middle_;
  double steps_ = 1;  // to the middle, in the first of them
};

}  // namespace

void close_by_rings(RepairState& state, const Rim& rim, bool as_fillers) {
  const Face first = state.face_count();
  RingCloser(state, rim).run();
  for (Face f = first; f < state.face_count(); ++f) state.fillers[f] = as_fillers ? 1 : 0;
}

}  // namespace sphparam
