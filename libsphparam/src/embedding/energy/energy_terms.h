#pragma once

#include <type_traits>

#include "lanes.h"
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

/// Of triangles that nothing presses: no number carries a mark in its sign.
template <class Base>
struct UnpressedTerms : Base {
  template <class Number>
  SPHPARAM_INLINE static Number plain(Number number) {
    return number;
  }
  template <class Number>
  SPHPARAM_INLINE Number triangle_value(Number d, Number s, Number) const {
    return Base::value(d, s);
  }
  template <class Number>
  SPHPARAM_INLINE EnergyTerms<Number> triangle_terms(Number d, Number s, Number) const {
    return Base::terms(d, s);
  }
};

/// The same with a pressure p on marked triangles: those with a negative α, or with a negative
/// base. F f gains p S there, the area of their image.
template <class Base>
struct PressedTerms : Base {
  double pressure;

  template <class Number>
  SPHPARAM_INLINE static Number plain(Number number) {
    return magnitude(number);
  }
  template <class Number>
  SPHPARAM_INLINE Number on(Number marked) const {
    return select(marked < 0.0, Number(pressure), Number(0.0));
  }
  template <class Number>
  SPHPARAM_INLINE Number triangle_value(Number d, Number s, Number base) const {
    return Base::value(d, s) + on(base) * s;
  }
  template <class Number>
  SPHPARAM_INLINE EnergyTerms<Number> triangle_terms(Number d, Number s, Number base) const {
    EnergyTerms<Number> terms = Base::terms(d, s);
    terms.f += on(base) * s;
    terms.f_s += on(base);
    return terms;
  }
  template <class Number>
  SPHPARAM_INLINE Number corner_value(Number k, Number s, Number alpha, Number beta) const {
    return Base::corner_value(k, s, magnitude(alpha), beta) + on(alpha) * s;
  }
  template <class Number>
  SPHPARAM_INLINE EnergyTerms<Number> corner_terms(Number k, Number s, Number alpha,
                                                   Number beta) const {
    EnergyTerms<Number> terms = Base::corner_terms(k, s, magnitude(alpha), beta);
    terms.f += on(alpha) * s;
    terms.f_s += on(alpha);
    return terms;
  }
};

/// visit(terms), the terms those of this energy. Its ε is not looked at.
template <class Visit>
decltype(auto) with_terms_of(const DistortionEnergy& energy, const Visit& visit) {
  const auto pressed_or_not = [&](const auto& base) -> decltype(auto) {
    using Base = std::decay_t<decltype(base)>;
    if (energy.pressure != 0) return visit(PressedTerms<Base>{base, energy.pressure});
    return visit(UnpressedTerms<Base>{base});
  };
  if (energy.kind == EnergyKind::SymmetricDirichlet) {
    return pressed_or_not(SymmetricDirichletTerms{});
  }
  return pressed_or_not(AngleAndAreaTerms{energy.lambda});
}

}  // namespace sphparam
