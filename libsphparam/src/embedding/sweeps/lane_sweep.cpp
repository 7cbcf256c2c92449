#include "embedding/sweeps/lane_sweep.h"

#include <cstddef>
#include <memory>

#include "embedding/energy/gathered_lanes.h"
#include "embedding/energy/ring_derivatives.h"
#include "ieee_arithmetic.h"
#include "sphparam/parallel.h"

// The inner loop of the progressive embedding: the vertices of a pack move at once, one a lane,
// each by a Newton step of its ring's energy (energy/ring_derivatives.h). A step is taken only
// where the guard (energy/orientation_guard.h) proves every triangle of the ring positive.

namespace sphparam {
namespace {

constexpr std::int64_t sweep_grain = 16;   // packs
constexpr double placement_margin = 0.02;  // a mean is accepted this far inside its ring,
constexpr double sliver_margin = 0.1;      // or this share of how far a rest triangle is
constexpr double plain_share = 1e-3;       // of the plain mean: keeps room however thin the slivers
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

/// Writes down the energies of rings, less the constant that slots beyond a lane's valence add.
template <class Terms, int W>
SPHPARAM_INLINE void note_energy(const Terms& energy, const Part<W>& part, Lanes<W> value,
                                 float* ring_energy) {
  const Lanes<W> zero = 0.0, empty = energy.corner_value(zero, Lanes<W>(1.0), zero, zero);
  for (int i = 0; i < part.valence(); ++i) value -= select(part.beta(i) > 0.0, zero, empty);
  for (int i = 0; i < W; ++i) {
    const Vertex v = part.pack.vertex[part.first + i];
    if (v >= 0) ring_energy[v] = static_cast<float>(value[i]);
  }
}

template <class Terms, int W>
SPHPARAM_INLINE void step_part(const Terms& energy, const Part<W>& part, ImagePoint* points,
                               double over_relaxation, LaneVectors<W>* ring, float* ring_energy) {
  for (int i = 0; i < part.valence(); ++i) ring[i] = gather<W>(points, part.neighbours(i));
  const LaneVectors<W> x = part.own(points);
  const RingModel<W> model = second_order_model(energy, part, ring, x);
  if (ring_energy) note_energy(energy, part, model.value, ring_energy);
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

/// The rest triangle of a slot, seen from its corner x. Lengths are over √8.
template <int W>
struct RestCorner {
  Lanes<W> base, side;  // |a|, |b|
  Lanes<W> half_angle;  // tan(θ/2), θ the angle between them: |b| ∓ |a|t over the height
  Lanes<W> height, shear;

  SPHPARAM_INLINE RestCorner(Lanes<W> alpha, Lanes<W> beta, Lanes<W> t)
      : base(root(beta)), side(root(beta * (t * t) + alpha)), height(root(alpha)), shear(t) {
    const Lanes<W> along = side + magnitude(t) * base;
    half_angle = select(t > 0.0, height / along, along / height);
  }

  /// 2F / (|a|² + |b − a|²)
  SPHPARAM_INLINE Lanes<W> quality() const {
    const Lanes<W> rest = base * (1.0 - shear);
    return base * height / (base * base + rest * rest + height * height);
  }
};

/// Puts the vertices where they lie in their rings as the rest triangles have them: at mean value
/// coordinates, the mean of their neighbours with weights (tan(θ/2) + tan(θ'/2)) / |a|. Next to a
/// near neighbour, then, where the plain mean would make room for it in the middle of the ring,
/// which no sweep takes back where triangles are slivers. Returns the lanes that are not well
/// inside.
/// Paper: Floater, "Mean value coordinates" (2003).
template <int W>
SPHPARAM_INLINE unsigned place_part(const Part<W>& part, ImagePoint* points, LaneVectors<W>* ring) {
  const int valence = part.valence();
  LaneVectors<W> weighted{0.0, 0.0, 0.0}, plain{0.0, 0.0, 0.0};
  Lanes<W> weight = 0.0, count = 0.0;
  const Lanes<W> zero = 0.0;
  for (int i = 0; i < valence; ++i) ring[i] = gather<W>(points, part.neighbours(i));
  for (int i = 0; i < valence; ++i) {
    const LaneMask<W> live = part.beta(i) > 0.0;
    const RestCorner<W> corner(part.alpha(i), part.beta(i), part.shear(i));
    const Lanes<W> to_p = select(live, corner.half_angle / corner.base, zero);
    const Lanes<W> to_q = select(live, corner.half_angle / corner.side, zero);
    weighted = weighted + to_p * ring[i] + to_q * ring[i + 1 == valence ? 0 : i + 1];
    weight += to_p + to_q;
    plain = select(live, plain + ring[i], plain);
    count += select(live, Lanes<W>(1.0), zero);
  }
  const LaneVectors<W> x =
      unit(((1.0 - plain_share) / weight) * weighted + (plain_share / count) * plain);
  // Few are not inside by the plain margin: only those are asked how thin their triangles may be.
  LaneMask<W> inside = ~LaneMask<W>{};
  const auto look = [&](const auto& margin) SPHPARAM_INLINED {
    inside = ~LaneMask<W>{};
    LaneVectors<W> a = ring[0] - x;
    const LaneVectors<W> first = a;
    for (int i = 0; i < valence; ++i) {
      const LaneVectors<W> b = i + 1 == valence ? first : ring[i + 1] - x, edge = b - a;
      const Lanes<W> size = dot(a, a) + dot(edge, edge);
      inside = inside & ((dot(x, cross(a, b)) > margin(i) * size) | ~(part.beta(i) > 0.0));
      a = b;
    }
  };
  look([](int) SPHPARAM_INLINED { return Lanes<W>(placement_margin); });
  if ((~inside).any()) {
    look([&](int i) SPHPARAM_INLINED {
      const RestCorner<W> corner(part.alpha(i), part.beta(i), part.shear(i));
      return smaller(Lanes<W>(placement_margin), sliver_margin * corner.quality());
    });
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
                ImagePoint* points, double over_relaxation, float* ring_energy) {
  RingBuffer buffer(packs.largest_valence);
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    LaneVectors<W>* ring = buffer.ring<W>();
    for_each_part<W>(packs, first, last, [&](int, const Part<W>& part) SPHPARAM_INLINED {
      step_part(energy, part, points, over_relaxation, ring, ring_energy);
    });
  });
}

}  // namespace

void step_packs(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                const DistortionEnergy& energy, double over_relaxation, float* ring_energy) {
  with_terms_of(energy, [&](const auto& terms) {
    step_range(terms, packs, first_pack, last_pack, points, over_relaxation, ring_energy);
  });
}

void sweep_packs(const RingPacks& packs, int first_colour, ImagePoint* points,
                 const DistortionEnergy& energy, double over_relaxation, int threads,
                 float* ring_energy) {
  for (int c = first_colour; c < packs.colours(); ++c) {
    const int begin = packs.colour_start[static_cast<size_t>(c)];
    const int end = packs.colour_start[static_cast<size_t>(c) + 1];
    parallel_for(end - begin, sweep_grain, threads, [&](std::int64_t first, std::int64_t last) {
      step_packs(packs, begin + static_cast<int>(first), begin + static_cast<int>(last), points,
                 energy, over_relaxation, ring_energy);
    });
  }
}

void place_in_rings(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
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
