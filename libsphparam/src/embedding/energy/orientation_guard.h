#pragma once

#include "ieee_arithmetic.h"
#include "lanes.h"

// The one guard of all sweeps and Newton steps. They take a step only if
//   ½ det(x, A, B) > margin·(|A|² + |B|²) + least,   A = p − x, B = q − x,
// for every triangle (x, p, q) that changes, all computed from the stored doubles.
//
// Theorem: then det(x, p, q) = det(x, A, B) > 0 exactly. Proof: let u = 2⁻⁵³. A and B have one
// rounding an entry; each product in A × B has three roundings, the difference a fourth, the factor
// xᵢ a fifth, the two sums a sixth and a seventh; halving is exact. So what is computed misses
// ½det by at most ½((1 + u)⁷ − 1) Σ|xᵢ|mᵢ + η, mᵢ = |Aⱼ||B_k| + |A_k||Bⱼ|, η from underflow. By
// Cauchy mᵢ² ≤ (|A|² − Aᵢ²)(|B|² − Bᵢ²), whose sum is at most 2|A|²|B|²; with |x| < 1.01 and
// 2|A||B| ≤ |A|² + |B|² that is less than 2.6u (|A|² + |B|²) + η < 3e-16 (|A|² + |B|²) + η. The
// margin 1e-14 is thirty times as much; the roundings of |A|² + |B|² itself change it by 1e-15 of
// its value. A dozen operations on numbers below 10 underflow by less than η = 100 · 2⁻¹⁰²², and
// least is 1e-290. ∎ So no exact predicate is needed where the guard holds.

namespace sphparam {

constexpr double guard_margin = 1e-14, guard_least = 1e-290;

/// Whether the exact determinant is positive, as far as rounding lets it be seen.
/// half_det: ½ det(x, A, B) as computed. squares: |A|² + |B|². Number: a double or lanes.
template <class Number>
SPHPARAM_INLINE auto certainly_positive(const Number& half_det, const Number& squares) {
  return half_det - guard_margin * squares > guard_least;
}

}  // namespace sphparam
