#include "embedding/sweeps/lane_sweep.h"

#include <cstddef>
#include <memory>

#include "embedding/energy/lanes.h"
#include "embedding/energy/ring_derivatives.h"
#include "sphere/ieee_arithmetic.h"

// The inner loop of the progressive embedding: the vertices of a pack move at once, one a lane,
// each by a Newton step of its ring's energy (energy/ring_derivatives.h). A step is taken only
// where the guard (energy/orientation_guard.h) proves every triangle of the ring positive.

namespace sphparam {
namespace {

constexpr double placement_margin = 0.02;  // a mean is accepted this far inside its ring
constexpr double first_step_cap = 0.5;     // radians
constexpr double step_shrink = 0.35;
constexpr int step_trials = 5;
constexpr double sufficient_decrease = 1e-4;
constexpr double negligible_decrease = 1e-9;  // of the ring's energy: not worth a step
constexpr double curvature_floor = 1e-3;      // of the larger eigenvalue

/// A pack's lanes from `first` on, as many as fit one register.
template <int W>
struct Part {
  const RingPack& pack;
  const RingSlot* slots;
  int first;

  int valence() const { return pack.valence; }
  SPHPARAM_INLINE const Vertex* neighbours(int i) const { return slots[i].neighbour + first; }
  SPHPARAM_INLINE Lanes<W> alpha(int i) const { return load<W>(slots[i].alpha + first); }
  SPHPARAM_INLINE Lanes<W> beta(int i) const { return load<W>(slots[i].beta + first); }
  SPHPARAM_INLINE Lanes<W> shear(int i) const { return load<W>(slots[i].shear + first); }

  /// The part's own vertices; empty lanes repeat the pack's first.
  SPHPARAM_INLINE LaneVectors<W> own(const ImagePoint* points) const {
    Vertex vertices[W];
    for (int i = 0; i < W; ++i) {
      const Vertex v = pack.vertex[first + i];
      vertices[i] = v < 0 ? pack.vertex[0] : v;
    }
    return gather<W>(points, vertices);
  }
  SPHPARAM_INLINE LaneMask<W> filled() const {
    LaneMask<W> m;
    for (int i = 0; i < W; ++i) m.v[i] = pack.vertex[first + i] < 0 ? 0 : -1;
    return m;
  }
  SPHPARAM_INLINE void scatter(const LaneVectors<W>& x, LaneMask<W> m, ImagePoint* points) const {
    for (int i = 0; i < W; ++i) {
      if (m[i]) points[pack.vertex[first + i]] = {x.x[i], x.y[i], x.z[i], 0};
    }
  }
};

/// The Newton step of the model with its eigenvalues raised to a positive floor.
template <int W>
struct Step {
  Lanes<W> p0, p1, decrease;
  LaneMask<W> worthwhile;
};

template <int W>
SPHPARAM_INLINE Step<W> newton_step(const RingModel<W>& m) {
  const Lanes<W> trace = m.h00 + m.h11, difference = m.h00 - m.h11;
  const Lanes<W> gap = root(difference * difference + 4.0 * (m.h01 * m.h01));
  const Lanes<W> floor = curvature_floor * magnitude(trace + gap);
  const Lanes<W> shift = larger(Lanes<W>(0.0), floor - 0.5 * (trace - gap));
  const Lanes<W> h00 = m.h00 + shift, h11 = m.h11 + shift;
  const Lanes<W> det = h00 * h11 - m.h01 * m.h01, inverse = 1.0 / det;
  Step<W> step;
  step.p0 = inverse * (m.h01 * m.g1 - h11 * m.g0);
  step.p1 = inverse * (m.h01 * m.g0 - h00 * m.g1);
  step.decrease = -(m.g0 * step.p0 + m.g1 * step.p1);
  step.worthwhile = m.defined & (det > 0.0) & (step.decrease > negligible_decrease * m.value);
  return step;
}

template <class Terms, int W>
SPHPARAM_INLINE void step_part(const Terms& energy, const Part<W>& part, ImagePoint* points,
                               double over_relaxation, LaneVectors<W>* ring) {
  for (int i = 0; i < part.valence(); ++i) ring[i] = gather<W>(points, part.neighbours(i));
  const LaneVectors<W> x = part.own(points);
  const RingModel<W> model = second_order_model(energy, part, ring, x);
  const Step<W> step = newton_step(model);
  LaneMask<W> todo = step.worthwhile & part.filled();
  if (!todo.any()) return;
  const Lanes<W> length = root(step.p0 * step.p0 + step.p1 * step.p1);
  Lanes<W> scale = smaller(Lanes<W>(over_relaxation), first_step_cap / length);
  const LaneVectors<W> p = step.p0 * model.b0 + step.p1 * model.b1;
  LaneVectors<W> moved = x;
  LaneMask<W> done;
  for (int trial = 0; trial < step_trials && todo.any(); ++trial) {
    const LaneVectors<W> y = unit(x + scale * p);
    LaneMask<W> certain;
    const Lanes<W> value = guarded_ring_energy(energy, part, ring, y, certain);
    const LaneMask<W> good =
        todo & certain & (value < model.value - sufficient_decrease * (scale * step.decrease));
    moved = select(good, y, moved);
    done = done | good;
    todo = todo & ~good;
    scale = step_shrink * scale;
  }
  part.scatter(moved, done, points);
}

/// The lanes whose ring means are not well inside.
template <int W>
SPHPARAM_INLINE unsigned place_part(const Part<W>& part, ImagePoint* points, LaneVectors<W>* ring) {
  LaneVectors<W> sum{0.0, 0.0, 0.0};
  for (int i = 0; i < part.valence(); ++i) {
    ring[i] = gather<W>(points, part.neighbours(i));
    sum = select(part.beta(i) > 0.0, sum + ring[i], sum);
  }
  const LaneVectors<W> x = unit(sum);
  LaneMask<W> inside = ~LaneMask<W>{};
  LaneVectors<W> a = ring[0] - x;
  const LaneVectors<W> first = a;
  for (int i = 0; i < part.valence(); ++i) {
    const LaneVectors<W> b = i + 1 == part.valence() ? first : ring[i + 1] - x, edge = b - a;
    const Lanes<W> size = dot(a, a) + dot(edge, edge);
    inside = inside & ((dot(x, cross(a, b)) > placement_margin * size) | ~(part.beta(i) > 0.0));
    a = b;
  }
  const LaneMask<W> filled = part.filled();
  part.scatter(x, inside & filled, points);
  unsigned refused = 0;
  for (int i = 0; i < W; ++i) refused |= (filled[i] && !inside[i]) ? 1u << i : 0u;
  return refused << part.first;
}

/// Calls visit(pack, part) for the packs of a range, part by part.
template <int W, class Visit>
SPHPARAM_INLINE void for_each_part(const RingPacks& packs, int first, int last,
                                   const Visit& visit) {
  for (int p = first; p < last; ++p) {
    const RingPack& pack = packs.packs[static_cast<size_t>(p)];
    for (int lane = 0; lane < pack_width; lane += W) {
      visit(p, Part<W>{pack, &packs.slots[pack.first_slot], lane});
    }
  }
}

/// Space for the rings of a pack. Only long ones are worth an allocation: loops are short.
class RingBuffer {
 public:
  explicit RingBuffer(int valence) {
    if (valence <= most_near) return;
    far_ = std::make_unique_for_overwrite<Neighbour[]>(static_cast<size_t>(valence));
  }
  template <int W>
  LaneVectors<W>* ring() {
    return reinterpret_cast<LaneVectors<W>*>(far_ ? far_.get() : near_);
  }

 private:
  static constexpr int most_near = 64;
  struct alignas(64) Neighbour {
    std::byte bytes[3 * pack_width * sizeof(double)];
  };

  Neighbour near_[most_near];
  std::unique_ptr<Neighbour[]> far_;
};

template <class Terms>
void step_range(const Terms& energy, const RingPacks& packs, int first, int last,
                ImagePoint* points, double over_relaxation) {
  RingBuffer buffer(packs.largest_valence);
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    LaneVectors<W>* ring = buffer.ring<W>();
    for_each_part<W>(packs, first, last, [&](int, const Part<W>& part) SPHPARAM_INLINED {
      step_part(energy, part, points, over_relaxation, ring);
    });
  });
}

}  // namespace

void step_packs(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                const DistortionEnergy& energy, double over_relaxation) {
  with_terms_of(energy, [&](const auto& terms) {
    step_range(terms, packs, first_pack, last_pack, points, over_relaxation);
  });
}

void place_at_means(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                    unsigned char* refused) {
  RingBuffer buffer(packs.largest_valence);
  for (int p = first_pack; p < last_pack; ++p) refused[p] = 0;
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    LaneVectors<W>* ring = buffer.ring<W>();
    for_each_part<W>(
        packs, first_pack, last_pack, [&](int p, const Part<W>& part) SPHPARAM_INLINED {
          refused[p] = static_cast<unsigned char>(refused[p] | place_part(part, points, ring));
        });
  });
}

}  // namespace sphparam
