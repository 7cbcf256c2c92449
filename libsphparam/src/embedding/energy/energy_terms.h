#pragma once

#include "embedding/energy/lanes.h"
#include "sphparam/embedding/distortion_energy.h"

// The density f(d, s) of either energy where nothing is folded (ε = 0; `differentiate` in
// distortion_energy.h is the regularised one), of one triangle (Number: double) or of W (Lanes<W>).
//
// Twice, as a triangle is seen twice. As a whole: d and s, as they are. From a corner x that moves:
// K = F² d and S = F s, F the rest area, which are had without a division (ring_slot.h); what is
// summed is F f:
//   angle and area:       f = (d + λ(s² + 1)/2)/s    F f = (K + 8λαβ)/S + λS/2      8αβ = F²/2
//   symmetric Dirichlet:  f = d (1 + 1/s²)           F f = K (1/F + F/S²)           F = 4√(αβ)
// Equal in exact arithmetic; their roundings differ, and the bits of maps are made of them: neither
// stands in for the other.

namespace sphparam {

/// f and its derivatives by d and s, or F f by K and S; f is linear in the first.
template <class Number>
struct EnergyTerms {
  Number f, f_d, f_s, f_ds, f_ss;
};

struct AngleAndAreaTerms {
  double lambda;

  template <class Number>
  SPHPARAM_INLINE Number value(Number d, Number s) const {
    return (d + 0.5 * lambda * (s * s + 1.0)) / s;
  }
  template <class Number>
  SPHPARAM_INLINE EnergyTerms<Number> terms(Number d, Number s) const {
    const Number i = 1.0 / s, f = (d + 0.5 * lambda * (s * s + 1.0)) * i;
    return {f, i, lambda - f * i, -i * i, (2.0 * f * i - lambda) * i};
  }

  template <class Number>
  SPHPARAM_INLINE Number corner_value(Number k, Number s, Number alpha, Number beta) const {
    return (k + 8 * lambda * (alpha * beta)) / s + 0.5 * lambda * s;
  }
  template <class Number>
  SPHPARAM_INLINE EnergyTerms<Number> corner_terms(Number k, Number s, Number alpha,
                                                   Number beta) const {
    const Number i = 1.0 / s, ki = (k + 8 * lambda * (alpha * beta)) * i, kii = ki * i;
    return {ki + 0.5 * lambda * s, i, 0.5 * lambda - kii, -(i * i), 2.0 * (kii * i)};
  }
};

struct SymmetricDirichletTerms {
  template <class Number>
  SPHPARAM_INLINE Number value(Number d, Number s) const {
    return d + d / (s * s);
  }
  template <class Number>
  SPHPARAM_INLINE EnergyTerms<Number> terms(Number d, Number s) const {
    const Number i = 1.0 / s, ii = i * i;
    return {d + d * ii, 1.0 + ii, -2.0 * d * ii * i, -2.0 * ii * i, 6.0 * d * ii * ii};
  }

  template <class Number>
  SPHPARAM_INLINE Number corner_value(Number k, Number s, Number alpha, Number beta) const {
    const Areas<Number> rest(alpha, beta);
    return k * (rest.inverse + rest.area / (s * s));
  }
  template <class Number>
  SPHPARAM_INLINE EnergyTerms<Number> corner_terms(Number k, Number s, Number alpha,
                                                   Number beta) const {
    const Areas<Number> rest(alpha, beta);
    const Number i = 1.0 / s, fii = rest.area * (i * i), h = rest.inverse + fii;
    const Number h_s = -2.0 * (fii * i);
    return {k * h, h, k * h_s, h_s, 6.0 * k * (fii * (i * i))};
  }

 private:
  /// F and 1/F; both zero where there is no triangle.
  template <class Number>
  struct Areas {
    Number area, inverse;
    SPHPARAM_INLINE Areas(Number alpha, Number beta)
        : area(4.0 * root(alpha * beta)), inverse(select(area > 0.0, 1.0 / area, Number(0.0))) {}
  };
};

/// visit(terms), the terms those of this energy. Its ε is not looked at.
template <class Visit>
decltype(auto) with_terms_of(const DistortionEnergy& energy, const Visit& visit) {
  if (energy.kind == EnergyKind::SymmetricDirichlet) return visit(SymmetricDirichletTerms{});
  return visit(AngleAndAreaTerms{energy.lambda});
}

}  // namespace sphparam
