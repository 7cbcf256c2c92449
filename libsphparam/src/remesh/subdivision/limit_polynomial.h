#pragma once

// A regular patch's polynomial, by Horner's scheme, of one place or of several lanes of them.

#include "lanes.h"
#include "sphparam/remesh/limit_surface.h"

namespace sphparam {

/// A polynomial of one component, and its derivatives.
template <class Number>
struct PolynomialValue {
  Number value, by_s, by_t;
};

/// Of its monomials in t that belong to sⁱ, those from tʲ down are still to come.
template <int first, int j, class Number>
SPHPARAM_INLINE void add_monomials(const double* c, const Number& t, Number& value, Number& by_t) {
  constexpr int apart = 3;
  if constexpr (j >= 0) {
    by_t = by_t * t + value;
    value = value * t + Number(c[apart * (first + j)]);
    add_monomials<first, j - 1>(c, t, value, by_t);
  }
}

/// Of its powers of s, those from sⁱ down are still to come.
template <Scheme scheme, int i, class Number>
SPHPARAM_INLINE void add_rows(const double* c, const Number& s, const Number& t,
                              PolynomialValue<Number>& p) {
  constexpr bool is_loop = scheme == Scheme::Loop;
  constexpr int rows = is_loop ? 5 : 4, length = is_loop ? rows - i : rows,
                first = is_loop ? rows * i - i * (i - 1) / 2 : rows * i, apart = 3;
  if constexpr (i >= 0) {
    // The first terms are what they begin with: nothing is multiplied by zero.
    Number value = c[apart * (first + length - 1)], by_t = 0.0;
    if constexpr (length > 1) {
      by_t = value;
      value = value * t + Number(c[apart * (first + length - 2)]);
      add_monomials<first, length - 3>(c, t, value, by_t);
    }
    if constexpr (i == rows - 1) {
      p = {value, 0.0, by_t};
    } else {
      p.by_s = i == rows - 2 ? p.value : p.by_s * s + p.value;
      p.value = p.value * s + value;
      p.by_t = p.by_t * s + by_t;
    }
    add_rows<scheme, i - 1>(c, s, t, p);
  }
}

/// Of coefficients a row of `LimitPatch::Coefficients` apart.
template <Scheme scheme, class Number>
SPHPARAM_INLINE PolynomialValue<Number> evaluate_polynomial(const double* c, const Number& s,
                                                            const Number& t) {
  PolynomialValue<Number> p{0.0, 0.0, 0.0};
  add_rows<scheme, scheme == Scheme::Loop ? 4 : 3>(c, s, t, p);
  return p;
}

/// Points of a limit surface and their first derivatives, W of them.
template <int W>
struct LimitLanes {
  LaneVectors<W> position, by_s, by_t;
};

template <Scheme scheme, int W>
SPHPARAM_INLINE LimitLanes<W> evaluate_polynomials(const LimitPatch::Coefficients& coefficients,
                                                   const Lanes<W>& s, const Lanes<W>& t) {
  const double* c = &coefficients(0, 0);
  const auto x = evaluate_polynomial<scheme>(c, s, t), y = evaluate_polynomial<scheme>(c + 1, s, t),
             z = evaluate_polynomial<scheme>(c + 2, s, t);
  return {{x.value, y.value, z.value}, {x.by_s, y.by_s, z.by_s}, {x.by_t, y.by_t, z.by_t}};
}

}  // namespace sphparam
