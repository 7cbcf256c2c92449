#pragma once

// The place of a direction q: D(s, t) = λq, by Newton. A step (δs, δt) solves
//   D + δs Dₛ + δt Dₜ = λ q,  so  δs = −det(D, Dₜ, q) / det(Dₛ, Dₜ, q),
//                                 δt = −det(Dₛ, D, q) / det(Dₛ, Dₜ, q).

#include "lanes.h"

namespace sphparam {

/// `Number` is one number, or several lanes of them.
template <class Number>
struct DirectionStep {
  Number s, t;
  Number det;    // positive where the surface of directions is the right way round,
  Number ahead;  // and this where its point is not behind
};

template <class Vector>
SPHPARAM_INLINE auto direction_step(const Vector& d, const Vector& by_s, const Vector& by_t,
                                    const Vector& q) {
  const auto det = dot(cross(by_s, by_t), q);
  return DirectionStep<decltype(dot(d, q))>{dot(cross(by_t, d), q) / det,
                                            dot(cross(d, by_s), q) / det, det, dot(d, q)};
}

}  // namespace sphparam
