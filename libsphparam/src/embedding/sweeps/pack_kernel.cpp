#include "embedding/sweeps/pack_kernel.h"

#include <cstddef>
#include <memory>

#include "embedding/energy/lanes.h"
#include "sphere/ieee_arithmetic.h"

// The inner loop of the progressive embedding: the vertices of a pack move at once, one a lane.
//
// For a vertex x with ring p₀ … p_{k−1}, A = pᵢ − x, B = pᵢ₊₁ − x (see ring_packs.cpp):
//   K = α|A|² + β|B − tA|²,  S = ½ det(x, A, B),  E = Σ f(K, S)
//   angle and area:        f = (K + 8λαβ)/S + λS/2      (8αβ = F²/2, F the source area)
//   symmetric Dirichlet:   f = K (1/F + F/S²)           (F = 4√(αβ))
// Differences are turned into the frame (b₀, b₁, x) first: the gradient of K is small there where
// x is near, and ∇²K = 2α + 2β(1 − t)² times the identity is constant. On the sphere the second
// derivative gains minus the radial derivative of E.
//
// The guard. A step is taken only if S > margin·(|A|² + |B|²) + least for every triangle, all from
// the stored doubles. Theorem: then det(x, A, B) > 0 exactly. Proof: let u = 2⁻⁵³. A and B have
// one rounding an entry; each product in A × B has three roundings, the difference a fourth, the
// factor xᵢ a fifth, the two sums a sixth and a seventh; halving is exact. So S misses ½det by at
// most ½((1 + u)⁷ − 1) Σ|xᵢ|mᵢ + η, mᵢ = |Aⱼ||B_k| + |A_k||Bⱼ|, η from underflow. By Cauchy
// mᵢ² ≤ (|A|² − Aᵢ²)(|B|² − Bᵢ²), whose sum is at most 2|A|²|B|²; with |x| < 1.01 and
// 2|A||B| ≤ |A|² + |B|² that is less than 2.6u (|A|² + |B|²) + η < 3e-16 (|A|² + |B|²) + η. The
// margin 1e-14 is thirty times as much; the roundings of |A|² + |B|² itself change it by 1e-15 of
// its value. A dozen operations on numbers below 10 underflow by less than η = 100 · 2⁻¹⁰²², and
// least is 1e-290. ∎ So no exact predicate is needed, and none is used.
//
// Slots beyond a lane's valence have α = β = 0 and twice the same neighbour: with S set to 1 there,
// they add a constant to E, pass the guard, and add nothing to derivatives but −S ∂f/∂S on the
// diagonal, which is masked.

namespace sphparam {
namespace {

constexpr double guard_margin = 1e-14, guard_least = 1e-290;
constexpr double placement_margin = 0.02;  // a mean is accepted this far inside its ring
constexpr double first_step_cap = 0.5;     // radians
constexpr double step_shrink = 0.35;
constexpr int step_trials = 5;
constexpr double sufficient_decrease = 1e-4;
constexpr double negligible_decrease = 1e-9;  // of the ring's energy: not worth a step
constexpr double curvature_floor = 1e-3;      // of the larger eigenvalue

/// f and its derivatives by K and S; f_kk = 0.
template <int W>
struct Terms {
  Lanes<W> f, f_k, f_s, f_ks, f_ss;
};

struct AngleAndArea {
  double lambda;

  template <int W>
  SPHPARAM_INLINE Lanes<W> value(Lanes<W> k, Lanes<W> s, Lanes<W> alpha, Lanes<W> beta) const {
    return (k + 8 * lambda * (alpha * beta)) / s + 0.5 * lambda * s;
  }
  template <int W>
  SPHPARAM_INLINE Terms<W> terms(Lanes<W> k, Lanes<W> s, Lanes<W> alpha, Lanes<W> beta) const {
    const Lanes<W> i = 1.0 / s, ki = (k + 8 * lambda * (alpha * beta)) * i, kii = ki * i;
    return {ki + 0.5 * lambda * s, i, 0.5 * lambda - kii, -(i * i), 2.0 * (kii * i)};
  }
};

struct SymmetricDirichlet {
  template <int W>
  SPHPARAM_INLINE static void areas(Lanes<W> alpha, Lanes<W> beta, Lanes<W>& area,
                                    Lanes<W>& inverse) {
    area = 4.0 * root(alpha * beta);
    inverse = select(area > 0.0, 1.0 / area, Lanes<W>(0.0));
  }
  template <int W>
  SPHPARAM_INLINE Lanes<W> value(Lanes<W> k, Lanes<W> s, Lanes<W> alpha, Lanes<W> beta) const {
    Lanes<W> area, inverse;
    areas(alpha, beta, area, inverse);
    return k * (inverse + area / (s * s));
  }
  template <int W>
  SPHPARAM_INLINE Terms<W> terms(Lanes<W> k, Lanes<W> s, Lanes<W> alpha, Lanes<W> beta) const {
    Lanes<W> area, inverse;
    areas(alpha, beta, area, inverse);
    const Lanes<W> i = 1.0 / s, fii = area * (i * i), h = inverse + fii, h_s = -2.0 * (fii * i);
    return {k * h, h, k * h_s, h_s, 6.0 * k * (fii * (i * i))};
  }
};

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

/// The ring's energy at y, and where the guard holds for every triangle.
template <class Energy, int W>
SPHPARAM_INLINE Lanes<W> guarded_energy(const Energy& energy, const Part<W>& part,
                                        const LaneVectors<W>* ring, const LaneVectors<W>& y,
                                        LaneMask<W>& certain) {
  Lanes<W> sum = 0.0;
  certain = ~LaneMask<W>{};
  LaneVectors<W> a = ring[0] - y;
  Lanes<W> aa = dot(a, a);
  const LaneVectors<W> first = a;
  const Lanes<W> first_aa = aa;
  for (int i = 0; i < part.valence(); ++i) {
    const bool last = i + 1 == part.valence();
    const LaneVectors<W> b = last ? first : ring[i + 1] - y;
    const Lanes<W> bb = last ? first_aa : dot(b, b);
    const Lanes<W> alpha = part.alpha(i), beta = part.beta(i);
    const Lanes<W> s = select(beta > 0.0, 0.5 * dot(y, cross(a, b)), Lanes<W>(1.0));
    certain = certain & (s - guard_margin * (aa + bb) > guard_least);
    const LaneVectors<W> u = b - part.shear(i) * a;
    sum += energy.value(alpha * aa + beta * dot(u, u), s, alpha, beta);
    a = b;
    aa = bb;
  }
  return sum;
}

/// Second-order model of the ring's energy in the tangent plane at x.
template <int W>
struct Model {
  Lanes<W> value = 0.0, g0 = 0.0, g1 = 0.0, h00 = 0.0, h01 = 0.0, h11 = 0.0;
  LaneVectors<W> b0, b1;
  LaneMask<W> defined = ~LaneMask<W>{};
};

template <class Energy, int W>
SPHPARAM_INLINE Model<W> second_order_model(const Energy& energy, const Part<W>& part,
                                            const LaneVectors<W>* ring, const LaneVectors<W>& x) {
  Model<W> m;
  // b₀ = x × e for the axis e that x is far from.
  const LaneMask<W> far = magnitude(x.x) < 0.6;
  const Lanes<W> zero = 0.0;
  m.b0 =
      unit(LaneVectors<W>{select(far, zero, -x.z), select(far, x.z, zero), select(far, -x.y, x.x)});
  m.b1 = cross(x, m.b0);
  const auto local = [&](const LaneVectors<W>& p) SPHPARAM_INLINED {
    const LaneVectors<W> d = p - x;
    return LaneVectors<W>{dot(d, m.b0), dot(d, m.b1), dot(d, x)};
  };
  LaneVectors<W> a = local(ring[0]);
  const LaneVectors<W> first = a;
  Lanes<W> isotropic = 0.0;
  for (int i = 0; i < part.valence(); ++i) {
    const LaneVectors<W> b = i + 1 == part.valence() ? first : local(ring[i + 1]);
    const Lanes<W> alpha = part.alpha(i), beta = part.beta(i), t = part.shear(i);
    const LaneMask<W> live = beta > 0.0;
    const Lanes<W> s = select(live, 0.5 * (a.x * b.y - a.y * b.x), Lanes<W>(1.0));
    m.defined = m.defined & (s > 0.0);
    const LaneVectors<W> u = b - t * a;
    const Terms<W> e = energy.terms(alpha * dot(a, a) + beta * dot(u, u), s, alpha, beta);
    m.value += e.f;
    // ∇K = −2αA − 2β(1 − t)(B − tA);  ∇S = ½(A × B) + ½ x × (A − B) in the tangent plane.
    const Lanes<W> flat = 1.0 - t, ka = -2.0 * alpha, kb = -2.0 * (beta * flat);
    const Lanes<W> k0 = ka * a.x + kb * u.x, k1 = ka * a.y + kb * u.y, kr = ka * a.z + kb * u.z;
    const Lanes<W> s0 = 0.5 * (a.y - b.y + (a.y * b.z - a.z * b.y));
    const Lanes<W> s1 = 0.5 * (b.x - a.x + (a.z * b.x - a.x * b.z));
    m.g0 += e.f_k * k0 + e.f_s * s0;
    m.g1 += e.f_k * k1 + e.f_s * s1;
    const Lanes<W> laplacian = -(ka + kb * flat);
    isotropic += e.f_k * (laplacian - kr) - select(live, e.f_s * s, zero);
    const Lanes<W> half = 0.5 * e.f_ss;
    const Lanes<W> w0 = e.f_ks * k0 + half * s0, w1 = e.f_ks * k1 + half * s1;
    m.h00 += (w0 + w0) * s0;
    m.h11 += (w1 + w1) * s1;
    m.h01 += w0 * s1 + w1 * s0;
    a = b;
  }
  m.h00 += isotropic;
  m.h11 += isotropic;
  return m;
}

/// The Newton step of the model with its eigenvalues raised to a positive floor.
template <int W>
struct Step {
  Lanes<W> p0, p1, decrease;
  LaneMask<W> worthwhile;
};

template <int W>
SPHPARAM_INLINE Step<W> newton_step(const Model<W>& m) {
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

template <class Energy, int W>
SPHPARAM_INLINE void step_part(const Energy& energy, const Part<W>& part, ImagePoint* points,
                               double over_relaxation, LaneVectors<W>* ring) {
  for (int i = 0; i < part.valence(); ++i) ring[i] = gather<W>(points, part.neighbours(i));
  const LaneVectors<W> x = part.own(points);
  const Model<W> model = second_order_model(energy, part, ring, x);
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
    const Lanes<W> value = guarded_energy(energy, part, ring, y, certain);
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

/// Room for the rings of a pack. Only long ones are worth an allocation: loops are short.
class RingRoom {
 public:
  explicit RingRoom(int valence) {
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
    std::byte room[3 * pack_width * sizeof(double)];
  };

  Neighbour near_[most_near];
  std::unique_ptr<Neighbour[]> far_;
};

template <class Energy>
void step_range(const Energy& energy, const RingPacks& packs, int first, int last,
                ImagePoint* points, double over_relaxation) {
  RingRoom room(packs.largest_valence);
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    LaneVectors<W>* ring = room.ring<W>();
    for_each_part<W>(packs, first, last, [&](int, const Part<W>& part) SPHPARAM_INLINED {
      step_part(energy, part, points, over_relaxation, ring);
    });
  });
}

}  // namespace

void step_packs(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                const DistortionEnergy& energy, double over_relaxation) {
  if (energy.kind == EnergyKind::SymmetricDirichlet) {
    step_range(SymmetricDirichlet{}, packs, first_pack, last_pack, points, over_relaxation);
  } else {
    step_range(AngleAndArea{energy.lambda}, packs, first_pack, last_pack, points, over_relaxation);
  }
}

void place_at_means(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                    unsigned char* refused) {
  RingRoom room(packs.largest_valence);
  for (int p = first_pack; p < last_pack; ++p) refused[p] = 0;
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    LaneVectors<W>* ring = room.ring<W>();
    for_each_part<W>(
        packs, first_pack, last_pack, [&](int p, const Part<W>& part) SPHPARAM_INLINED {
          refused[p] = static_cast<unsigned char>(refused[p] | place_part(part, points, ring));
        });
  });
}

}  // namespace sphparam
