#include "embedding/pack_kernel.h"

// The inner loop of the progressive embedding: eight vertices move at once, one a lane.
//
// For a vertex x with ring p₀ … p_{k−1}, A = pᵢ − x, B = pᵢ₊₁ − x (see ring_packs.cpp):
//   K = α|A|² + β|B − tA|²,  S = ½ det(x, A, B),  E = Σ K h(S) + g(S)
//   angle and area:        h = 1/S,          g = λ(8αβ/S + S/2)      (8αβ = F²/2)
//   symmetric Dirichlet:   h = 1/F + F/S²,   g = 0                   (F = 4√(αβ))
// Differences are turned into the frame (b₀, b₁, x) first: the gradient of K is small there where
// x is near, and ∇²K = 2α + 2β(1 − t)² times the identity is constant. On the sphere the second
// derivative gains minus the radial derivative of E.
//
// The guard. A step is taken only if S > margin·(|A|² + |B|²) for every triangle, with S computed
// from the stored doubles. Let u = 2⁻⁵³. A and B carry a relative error u per entry, the products
// and differences of the cross product 2u, the scalar product 3u: with mᵢ = |Aⱼ||B_k| + |A_k||Bⱼ|
// the error of det is at most 8u Σ|xᵢ|mᵢ ≤ 8u · |x| · (2/√3)|A||B| < 10u (|A|² + |B|²)/2, that of S
// at most 2.5u(|A|² + |B|²) ≈ 2.8e-16(|A|² + |B|²). The margin is 1e-14: whoever passes has an
// exactly positive determinant, with a factor of thirty to spare for the rounding of the bound
// itself and of |x| = 1. So no exact predicate is needed, and none is used.
//
// Bits. Only + − × ÷ √ and comparisons, each rounded once (contraction is off), in a fixed order a
// lane: every instruction set gives the same bits.

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define SPHPARAM_MULTIVERSION __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SPHPARAM_MULTIVERSION
#endif
#define SPHPARAM_INLINE inline __attribute__((always_inline))

#include <cmath>

namespace sphparam {
namespace {

using Mask = long long __attribute__((vector_size(8 * pack_width)));  // −1 true, 0 false
using FloatLanes = float __attribute__((vector_size(4 * pack_width)));

constexpr double guard_margin = 1e-14;
constexpr double placement_margin = 0.02;  // a mean is accepted this far inside its ring
constexpr double first_step_cap = 0.5;     // radians
constexpr double step_shrink = 0.35;
constexpr int step_trials = 5;
constexpr double sufficient_decrease = 1e-4;
constexpr double negligible_decrease = 1e-9;  // of the ring's energy: not worth a step
constexpr double curvature_floor = 1e-3;      // of the larger eigenvalue

SPHPARAM_INLINE Lanes splat(double value) { return value - Lanes{}; }
SPHPARAM_INLINE Lanes widen(const float* values) {
  FloatLanes f;
  __builtin_memcpy(&f, values, sizeof f);
  return __builtin_convertvector(f, Lanes);
}
SPHPARAM_INLINE Lanes root(Lanes a) {
  for (int i = 0; i < pack_width; ++i) a[i] = __builtin_sqrt(a[i]);
  return a;
}
SPHPARAM_INLINE bool any(Mask m) {
  long long bits = 0;
  for (int i = 0; i < pack_width; ++i) bits |= m[i];
  return bits != 0;
}
SPHPARAM_INLINE Lanes smaller(Lanes a, Lanes b) { return a < b ? a : b; }
SPHPARAM_INLINE Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }

SPHPARAM_INLINE Lanes dot(const LaneVectors& a, const LaneVectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
SPHPARAM_INLINE LaneVectors minus(const LaneVectors& a, const LaneVectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
SPHPARAM_INLINE LaneVectors times(Lanes s, const LaneVectors& a) {
  return {s * a.x, s * a.y, s * a.z};
}
SPHPARAM_INLINE LaneVectors cross(const LaneVectors& a, const LaneVectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
SPHPARAM_INLINE LaneVectors select(Mask m, const LaneVectors& a, const LaneVectors& b) {
  return {m ? a.x : b.x, m ? a.y : b.y, m ? a.z : b.z};
}
SPHPARAM_INLINE LaneVectors unit(const LaneVectors& a) { return times(1.0 / root(dot(a, a)), a); }

SPHPARAM_INLINE LaneVectors gather(const ImagePoint* points, const Vertex* vertices) {
  LaneVectors r;
  for (int i = 0; i < pack_width; ++i) {
    const ImagePoint& p = points[vertices[i]];
    r.x[i] = p.x;
    r.y[i] = p.y;
    r.z[i] = p.z;
  }
  return r;
}

/// The pack's own points; empty lanes repeat the first.
SPHPARAM_INLINE LaneVectors gather_own(const ImagePoint* points, const RingPack& pack) {
  Vertex vertices[pack_width];
  for (int i = 0; i < pack_width; ++i) {
    vertices[i] = pack.vertex[i] < 0 ? pack.vertex[0] : pack.vertex[i];
  }
  return gather(points, vertices);
}

SPHPARAM_INLINE Mask filled_lanes(const RingPack& pack) {
  Mask m;
  for (int i = 0; i < pack_width; ++i) m[i] = pack.vertex[i] < 0 ? 0 : -1;
  return m;
}

SPHPARAM_INLINE void scatter(const LaneVectors& x, Mask m, const RingPack& pack,
                             ImagePoint* points) {
  for (int i = 0; i < pack_width; ++i) {
    if (m[i]) points[pack.vertex[i]] = {x.x[i], x.y[i], x.z[i], 0};
  }
}

/// h(S), its derivatives, and g(S) with derivatives, of the angle-and-area energy.
struct AngleAndArea {
  double lambda;

  struct Terms {
    Lanes h, h1, h2, g, g1, g2;
  };
  SPHPARAM_INLINE Terms terms(Lanes s, Lanes alpha, Lanes beta) const {
    const Lanes i = 1.0 / s, c = 8 * lambda * alpha * beta, ii = i * i;
    return {
        i, -ii, 2.0 * ii * i, c * i + 0.5 * lambda * s, 0.5 * lambda - c * ii, 2.0 * c * ii * i};
  }
  SPHPARAM_INLINE Lanes value(Lanes k, Lanes s, Lanes alpha, Lanes beta) const {
    return (k + 8 * lambda * alpha * beta) / s + 0.5 * lambda * s;
  }
};

struct SymmetricDirichlet {
  SPHPARAM_INLINE AngleAndArea::Terms terms(Lanes s, Lanes alpha, Lanes beta) const {
    const Lanes area = 4.0 * root(alpha * beta), i = 1.0 / s, ii = i * i;
    const Lanes inverse_area = area > Lanes{} ? 1.0 / area : Lanes{};
    return {inverse_area + area * ii,
            -2.0 * area * ii * i,
            6.0 * area * ii * ii,
            Lanes{},
            Lanes{},
            Lanes{}};
  }
  SPHPARAM_INLINE Lanes value(Lanes k, Lanes s, Lanes alpha, Lanes beta) const {
    const Lanes area = 4.0 * root(alpha * beta);
    const Lanes inverse_area = area > Lanes{} ? 1.0 / area : Lanes{};
    return k * (inverse_area + area / (s * s));
  }
};

/// The ring's energy at y, and where the guard holds for every triangle.
template <class Energy>
SPHPARAM_INLINE Lanes guarded_energy(const Energy& energy, const RingPack& pack,
                                     const RingSlot* slots, const LaneVectors* ring,
                                     const LaneVectors& y, Mask& certain) {
  Lanes sum{};
  certain = ~Mask{};
  LaneVectors a = minus(ring[0], y);
  const LaneVectors first = a;
  Lanes aa = dot(a, a);
  const Lanes first_aa = aa;
  for (int i = 0; i < pack.valence; ++i) {
    LaneVectors b = first;
    Lanes bb = first_aa;
    if (i + 1 < pack.valence) {
      b = minus(ring[i + 1], y);
      bb = dot(b, b);
    }
    const Lanes alpha = widen(slots[i].alpha), beta = widen(slots[i].beta);
    const Lanes t = widen(slots[i].shear);
    const Mask live = beta > Lanes{};
    Lanes s = 0.5 * dot(y, cross(a, b));
    certain &= (s > guard_margin * (aa + bb)) | ~live;
    s = live ? s : splat(1);
    const LaneVectors u = minus(b, times(t, a));
    const Lanes k = alpha * aa + beta * dot(u, u);
    const Lanes e = energy.value(k, s, alpha, beta);
    sum = sum + (live ? e : Lanes{});
    a = b;
    aa = bb;
  }
  return sum;
}

/// Second-order model of the ring's energy in the tangent plane at x.
struct Model {
  Lanes value{}, g0{}, g1{}, h00{}, h01{}, h11{};
  LaneVectors b0, b1;
  Mask defined = ~Mask{};
};

template <class Energy>
SPHPARAM_INLINE Model second_order_model(const Energy& energy, const RingPack& pack,
                                         const RingSlot* slots, const LaneVectors* ring,
                                         const LaneVectors& x) {
  Model m;
  // b₀ = x × e for the axis e that x is far from.
  const Mask near_x = (x.x < splat(0.6)) & (x.x > splat(-0.6));
  const Lanes zero{};
  m.b0 = unit({near_x ? zero : -x.z, near_x ? x.z : zero, near_x ? -x.y : x.x});
  m.b1 = cross(x, m.b0);
  const auto local = [&](const LaneVectors& p) __attribute__((always_inline)) {
    const LaneVectors d = minus(p, x);
    return LaneVectors{dot(d, m.b0), dot(d, m.b1), dot(d, x)};
  };
  LaneVectors a = local(ring[0]);
  const LaneVectors first = a;
  Lanes isotropic{};
  for (int i = 0; i < pack.valence; ++i) {
    const LaneVectors b = i + 1 < pack.valence ? local(ring[i + 1]) : first;
    const Lanes alpha = widen(slots[i].alpha), beta = widen(slots[i].beta);
    const Lanes t = widen(slots[i].shear);
    const Mask live = beta > zero;
    Lanes s = 0.5 * (a.x * b.y - a.y * b.x);
    s = live ? s : splat(1);
    m.defined &= s > zero;
    const LaneVectors u = minus(b, times(t, a));
    const Lanes k = alpha * dot(a, a) + beta * dot(u, u);
    const auto e = energy.terms(s, alpha, beta);
    const Lanes value = k * e.h + e.g;
    Lanes f_s = k * e.h1 + e.g1, f_ss = k * e.h2 + e.g2;
    m.value = m.value + (live ? value : zero);
    f_s = live ? f_s : zero;
    f_ss = live ? f_ss : zero;
    const Lanes f_k = e.h, f_ks = e.h1;  // times ∇K, which is zero in dead slots
    // ∇K = −2αA − 2β(1 − t)(B − tA);  ∇S = ½(A × B) + ½ x × (A − B) in the tangent plane.
    const Lanes ka = -2.0 * alpha, kb = -2.0 * beta * (1.0 - t);
    const Lanes k0 = ka * a.x + kb * u.x, k1 = ka * a.y + kb * u.y, kr = ka * a.z + kb * u.z;
    const Lanes s0 = 0.5 * (a.y - b.y + a.y * b.z - a.z * b.y);
    const Lanes s1 = 0.5 * (b.x - a.x + a.z * b.x - a.x * b.z);
    m.g0 = m.g0 + f_k * k0 + f_s * s0;
    m.g1 = m.g1 + f_k * k1 + f_s * s1;
    const Lanes laplacian = -ka - kb * (1.0 - t);
    isotropic = isotropic + f_k * (laplacian - kr) - f_s * s;
    const Lanes w0 = f_ks * k0 + 0.5 * f_ss * s0, w1 = f_ks * k1 + 0.5 * f_ss * s1;
    m.h00 = m.h00 + 2.0 * w0 * s0;
    m.h11 = m.h11 + 2.0 * w1 * s1;
    m.h01 = m.h01 + w0 * s1 + w1 * s0;
    a = b;
  }
  m.h00 = m.h00 + isotropic;
  m.h11 = m.h11 + isotropic;
  return m;
}

/// The Newton step of the model with its eigenvalues raised to a positive floor.
struct Step {
  Lanes p0, p1, decrease;
  Mask worthwhile;
};

SPHPARAM_INLINE Step newton_step(const Model& m) {
  const Lanes trace = m.h00 + m.h11, difference = m.h00 - m.h11;
  const Lanes gap = root(difference * difference + 4.0 * m.h01 * m.h01);
  const Lanes magnitude = trace + gap;
  const Lanes floor = curvature_floor * (magnitude < Lanes{} ? -magnitude : magnitude);
  const Lanes shift = larger(Lanes{}, floor - 0.5 * (trace - gap));
  const Lanes h00 = m.h00 + shift, h11 = m.h11 + shift;
  const Lanes det = h00 * h11 - m.h01 * m.h01, inverse = 1.0 / det;
  Step step;
  step.p0 = inverse * (m.h01 * m.g1 - h11 * m.g0);
  step.p1 = inverse * (m.h01 * m.g0 - h00 * m.g1);
  step.decrease = -(m.g0 * step.p0 + m.g1 * step.p1);
  step.worthwhile = m.defined & (det > Lanes{}) & (step.decrease > negligible_decrease * m.value);
  return step;
}

template <class Energy>
SPHPARAM_INLINE void step_pack(const Energy& energy, const RingPack& pack, const RingSlot* slots,
                               ImagePoint* points, double over_relaxation, LaneVectors* ring) {
  for (int i = 0; i < pack.valence; ++i) ring[i] = gather(points, slots[i].neighbour);
  const LaneVectors x = gather_own(points, pack);
  const Model model = second_order_model(energy, pack, slots, ring, x);
  const Step step = newton_step(model);
  Mask todo = step.worthwhile & filled_lanes(pack);
  if (!any(todo)) return;
  const Lanes length = root(step.p0 * step.p0 + step.p1 * step.p1);
  Lanes scale = smaller(splat(over_relaxation), first_step_cap / length);
  const LaneVectors p{step.p0 * model.b0.x + step.p1 * model.b1.x,
                      step.p0 * model.b0.y + step.p1 * model.b1.y,
                      step.p0 * model.b0.z + step.p1 * model.b1.z};
  LaneVectors moved = x;
  Mask done{};
  for (int trial = 0; trial < step_trials && any(todo); ++trial) {
    const LaneVectors y = unit({x.x + scale * p.x, x.y + scale * p.y, x.z + scale * p.z});
    Mask certain;
    const Lanes value = guarded_energy(energy, pack, slots, ring, y, certain);
    const Mask good =
        todo & certain & (value < model.value - sufficient_decrease * scale * step.decrease);
    moved = select(good, y, moved);
    done |= good;
    todo &= ~good;
    scale = step_shrink * scale;
  }
  scatter(moved, done, pack, points);
}

template <class Energy>
SPHPARAM_INLINE void step_range(const Energy& energy, const RingPacks& packs, int first, int last,
                                ImagePoint* points, double over_relaxation, LaneVectors* scratch) {
  for (int p = first; p < last; ++p) {
    const RingPack& pack = packs.packs[static_cast<size_t>(p)];
    step_pack(energy, pack, &packs.slots[pack.first_slot], points, over_relaxation, scratch);
  }
}

SPHPARAM_INLINE unsigned char place_pack(const RingPack& pack, const RingSlot* slots,
                                         ImagePoint* points, LaneVectors* ring) {
  LaneVectors sum{};
  for (int i = 0; i < pack.valence; ++i) {
    ring[i] = gather(points, slots[i].neighbour);
    const Mask live = widen(slots[i].beta) > Lanes{};
    sum = select(live, {sum.x + ring[i].x, sum.y + ring[i].y, sum.z + ring[i].z}, sum);
  }
  const LaneVectors x = unit(sum);
  Mask inside = ~Mask{};
  LaneVectors a = minus(ring[0], x);
  const LaneVectors first = a;
  for (int i = 0; i < pack.valence; ++i) {
    const LaneVectors b = i + 1 < pack.valence ? minus(ring[i + 1], x) : first;
    const Mask live = widen(slots[i].beta) > Lanes{};
    const LaneVectors edge = minus(b, a);
    const Lanes size = dot(a, a) + dot(edge, edge);
    inside &= (dot(x, cross(a, b)) > placement_margin * size) | ~live;
    a = b;
  }
  const Mask filled = filled_lanes(pack);
  scatter(x, inside & filled, pack, points);
  unsigned refused = 0;
  for (int i = 0; i < pack_width; ++i) refused |= (filled[i] && !inside[i]) ? 1u << i : 0u;
  return static_cast<unsigned char>(refused);
}

SPHPARAM_MULTIVERSION
void step_angle_and_area(const RingPacks& packs, int first, int last, ImagePoint* points,
                         double lambda, double over_relaxation, LaneVectors* scratch) {
  step_range(AngleAndArea{lambda}, packs, first, last, points, over_relaxation, scratch);
}

SPHPARAM_MULTIVERSION
void step_symmetric_dirichlet(const RingPacks& packs, int first, int last, ImagePoint* points,
                              double over_relaxation, LaneVectors* scratch) {
  step_range(SymmetricDirichlet{}, packs, first, last, points, over_relaxation, scratch);
}

SPHPARAM_MULTIVERSION
void place_range(const RingPacks& packs, int first, int last, ImagePoint* points,
                 unsigned char* refused, LaneVectors* scratch) {
  for (int p = first; p < last; ++p) {
    const RingPack& pack = packs.packs[static_cast<size_t>(p)];
    refused[p] = place_pack(pack, &packs.slots[pack.first_slot], points, scratch);
  }
}

}  // namespace

void step_packs(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                const DistortionEnergy& energy, double over_relaxation, LaneVectors* scratch) {
  if (energy.kind == EnergyKind::SymmetricDirichlet) {
    step_symmetric_dirichlet(packs, first_pack, last_pack, points, over_relaxation, scratch);
  } else {
    step_angle_and_area(packs, first_pack, last_pack, points, energy.lambda, over_relaxation,
                        scratch);
  }
}

void place_at_means(const RingPacks& packs, int first_pack, int last_pack, ImagePoint* points,
                    unsigned char* refused, LaneVectors* scratch) {
  place_range(packs, first_pack, last_pack, points, refused, scratch);
}

}  // namespace sphparam
