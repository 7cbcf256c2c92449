#pragma once

#include "embedding/energy/energy_terms.h"
#include "embedding/energy/orientation_guard.h"
#include "lanes.h"

// The energy of the rings of W vertices x, one a lane, as functions of x alone: the value and the
// second-order model. For a ring p₀ … p_{k−1}, A = pᵢ − x, B = pᵢ₊₁ − x (see ring_slot.h):
//   K = α|A|² + β|B − tA|²,  S = ½ det(x, A, B),  E = Σ F f(K, S)
// Differences are turned into the frame (b₀, b₁, x) first: the gradient of K is small there where
// x is near, and ∇²K = 2α + 2β(1 − t)² times the identity is constant. On the sphere the second
// derivative gains minus the radial derivative of E.
//
// Slots beyond a lane's valence have α = β = 0 and twice the same neighbour: with S set to 1 there,
// they add a constant to E, pass the guard, and add nothing to derivatives but −S ∂f/∂S on the
// diagonal, which is masked.
//
// `RestRing` has valence() and, of slot i, alpha(i), beta(i) and shear(i); `ring` has the points. A
// negative α marks a triangle that is pressed (PressedTerms).

namespace sphparam {

/// The energy at y, and where the guard holds for every triangle.
template <class Terms, class RestRing, int W>
SPHPARAM_INLINE Lanes<W> guarded_ring_energy(const Terms& energy, const RestRing& rest,
                                             const LaneVectors<W>* ring, const LaneVectors<W>& y,
                                             LaneMask<W>& certain) {
  Lanes<W> sum = 0.0;
  certain = ~LaneMask<W>{};
  LaneVectors<W> a = ring[0] - y;
  Lanes<W> aa = dot(a, a);
  const LaneVectors<W> first = a;
  const Lanes<W> first_aa = aa;
  for (int i = 0; i < rest.valence(); ++i) {
    const bool last = i + 1 == rest.valence();
    const LaneVectors<W> b = last ? first : ring[i + 1] - y;
    const Lanes<W> bb = last ? first_aa : dot(b, b);
    const Lanes<W> alpha = rest.alpha(i), beta = rest.beta(i);
    const Lanes<W> s = select(beta > 0.0, 0.5 * dot(y, cross(a, b)), Lanes<W>(1.0));
    certain = certain & certainly_positive(s, aa + bb);
    const LaneVectors<W> u = b - rest.shear(i) * a;
    sum += energy.corner_value(energy.plain(alpha) * aa + beta * dot(u, u), s, alpha, beta);
    a = b;
    aa = bb;
  }
  return sum;
}

/// Value, gradient and Hessian in the tangent plane at x, spanned by b₀ and b₁.
template <int W>
struct RingModel {
  Lanes<W> value = 0.0, g0 = 0.0, g1 = 0.0, h00 = 0.0, h01 = 0.0, h11 = 0.0;
  LaneVectors<W> b0, b1;
  LaneMask<W> defined = ~LaneMask<W>{};  // where every S is positive, as computed
};

/// The exact second-order model at x.
template <class Terms, class RestRing, int W>
SPHPARAM_INLINE RingModel<W> second_order_model(const Terms& energy, const RestRing& rest,
                                                const LaneVectors<W>* ring,
                                                const LaneVectors<W>& x) {
  RingModel<W> m;
  // The frame: b₀ = x × e for the axis e that x is far from.
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
  for (int i = 0; i < rest.valence(); ++i) {
    // The triangle's K and S, and f's derivatives by them.
    const LaneVectors<W> b = i + 1 == rest.valence() ? first : local(ring[i + 1]);
    const Lanes<W> marked = rest.alpha(i), alpha = energy.plain(marked);
    const Lanes<W> beta = rest.beta(i), t = rest.shear(i);
    const LaneMask<W> live = beta > 0.0;
    const Lanes<W> s = select(live, 0.5 * (a.x * b.y - a.y * b.x), Lanes<W>(1.0));
    m.defined = m.defined & (s > 0.0);
    const LaneVectors<W> u = b - t * a;
    const EnergyTerms<Lanes<W>> e =
        energy.corner_terms(alpha * dot(a, a) + beta * dot(u, u), s, marked, beta);
    m.value += e.f;
    // ∇K = −2αA − 2β(1 − t)(B − tA);  ∇S = ½(A × B) + ½ x × (B − A) in the tangent plane.
    const Lanes<W> flat = 1.0 - t, ka = -2.0 * alpha, kb = -2.0 * (beta * flat);
    const Lanes<W> k0 = ka * a.x + kb * u.x, k1 = ka * a.y + kb * u.y, kr = ka * a.z + kb * u.z;
    const Lanes<W> s0 = 0.5 * (a.y - b.y + (a.y * b.z - a.z * b.y));
    const Lanes<W> s1 = 0.5 * (b.x - a.x + (a.z * b.x - a.x * b.z));
    m.g0 += e.f_d * k0 + e.f_s * s0;
    m.g1 += e.f_d * k1 + e.f_s * s1;
    // f_K ∇²K less the radial derivative: a multiple of the identity.
    const Lanes<W> laplacian = -(ka + kb * flat);
    isotropic += e.f_d * (laplacian - kr) - select(live, e.f_s * s, zero);
    // f_KS(∇K∇Sᵀ + ∇S∇Kᵀ) + f_SS ∇S∇Sᵀ = w∇Sᵀ + ∇Swᵀ with w = f_KS ∇K + ½f_SS ∇S
    const Lanes<W> half = 0.5 * e.f_ss;
    const Lanes<W> w0 = e.f_ds * k0 + half * s0, w1 = e.f_ds * k1 + half * s1;
    m.h00 += (w0 + w0) * s0;
    m.h11 += (w1 + w1) * s1;
    m.h01 += w0 * s1 + w1 * s0;
    a = b;
  }
  m.h00 += isotropic;
  m.h11 += isotropic;
  return m;
}

}  // namespace sphparam
