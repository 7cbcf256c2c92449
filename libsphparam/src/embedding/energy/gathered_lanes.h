#pragma once

#include "embedding/energy/image_point.h"
#include "lanes.h"

namespace sphparam {

/// W points of a table, wherever they are in it.
template <int W>
SPHPARAM_INLINE LaneVectors<W> gather(const ImagePoint* points, const int* indices) {
  using Four = double __attribute__((vector_size(32)));
  const auto four = [&](int i) SPHPARAM_INLINED {
    Four p;
    __builtin_memcpy(&p, points + indices[i], sizeof p);
    return p;
  };
  if constexpr (W == 4) {
    const Four r0 = four(0), r1 = four(1), r2 = four(2), r3 = four(3);
    const Four xz01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
    const Four xz23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
    const Four y01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
    const Four y23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
    return {__builtin_shufflevector(xz01, xz23, 0, 1, 4, 5),
            __builtin_shufflevector(y01, y23, 0, 1, 4, 5),
            __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7)};
  } else if constexpr (W == 8) {
    const auto eight = [&](int i) SPHPARAM_INLINED {
      return __builtin_shufflevector(four(i), four(i + 4), 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const auto r0 = eight(0), r1 = eight(1), r2 = eight(2), r3 = eight(3);
    const auto xz01 = __builtin_shufflevector(r0, r1, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto xz23 = __builtin_shufflevector(r2, r3, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto y01 = __builtin_shufflevector(r0, r1, 1, 9, 3, 11, 5, 13, 7, 15);
    const auto y23 = __builtin_shufflevector(r2, r3, 1, 9, 3, 11, 5, 13, 7, 15);
    return {__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(y01, y23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15)};
  } else {
    LaneVectors<W> r{0.0, 0.0, 0.0};
    for (int i = 0; i < W; ++i) {
      const ImagePoint& p = points[indices[i]];
      r.x.v[i] = p.x;
      r.y.v[i] = p.y;
      r.z.v[i] = p.z;
    }
    return r;
  }
}

/// The same from rows of three doubles.
template <int W>
SPHPARAM_INLINE LaneVectors<W> gather(const Points& points, const int* indices) {
  LaneVectors<W> r{0.0, 0.0, 0.0};
  for (int i = 0; i < W; ++i) {
    const double* p = points.data() + 3 * static_cast<std::ptrdiff_t>(indices[i]);
    r.x.v[i] = p[0];
    r.y.v[i] = p[1];
    r.z.v[i] = p[2];
  }
  return r;
}

}  // namespace sphparam
