#pragma once

#include <type_traits>

#include "embedding/energy/image_point.h"

// Vectors of W doubles, W chosen by the machine, for loops that treat eight lanes a pack.
//
// Such loops are templates over W, always inlined into one function for each instruction set. They
// take a pack in 8/W parts; lanes do not know of each other, every operation is rounded once
// (contraction is off) and their order is written down: all instruction sets give the same bits.

#define SPHPARAM_INLINED __attribute__((always_inline))
#define SPHPARAM_INLINE inline SPHPARAM_INLINED

namespace sphparam {

/// Vertices or triangles that are treated together, whatever the machine: the result has the same
/// bits everywhere.
inline constexpr int pack_width = 8;

/// The compiler's vectors; the attribute takes no template parameter.
template <int W>
struct Vectors;
#define SPHPARAM_VECTORS(W)                                         \
  template <>                                                       \
  struct Vectors<W> {                                               \
    using Doubles = double __attribute__((vector_size(8 * W)));     \
    using Integers = long long __attribute__((vector_size(8 * W))); \
    using Floats = float __attribute__((vector_size(4 * W)));       \
  }
SPHPARAM_VECTORS(2);
SPHPARAM_VECTORS(4);
SPHPARAM_VECTORS(8);
#undef SPHPARAM_VECTORS

/// −1 true, 0 false.
template <int W>
struct LaneMask {
  using Vector = typename Vectors<W>::Integers;
  Vector v{};

  SPHPARAM_INLINE bool operator[](int i) const { return v[i] != 0; }
  SPHPARAM_INLINE bool any() const {
    long long bits = 0;
    for (int i = 0; i < W; ++i) bits |= v[i];
    return bits != 0;
  }
  friend SPHPARAM_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
  friend SPHPARAM_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {a.v | b.v}; }
  SPHPARAM_INLINE LaneMask operator~() const { return {~v}; }
};

template <int W>
struct Lanes {
  using Vector = typename Vectors<W>::Doubles;
  Vector v;

  Lanes() = default;
  SPHPARAM_INLINE Lanes(Vector vector) : v(vector) {}
  SPHPARAM_INLINE Lanes(double value) : v(value - Vector{}) {}

  SPHPARAM_INLINE double operator[](int i) const { return v[i]; }
  SPHPARAM_INLINE Lanes operator-() const { return -v; }
  friend SPHPARAM_INLINE Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
  friend SPHPARAM_INLINE Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
  friend SPHPARAM_INLINE Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
  friend SPHPARAM_INLINE Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
  SPHPARAM_INLINE Lanes& operator+=(Lanes b) { return v += b.v, *this; }
  SPHPARAM_INLINE Lanes& operator-=(Lanes b) { return v -= b.v, *this; }
  friend SPHPARAM_INLINE LaneMask<W> operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
  friend SPHPARAM_INLINE LaneMask<W> operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
  friend SPHPARAM_INLINE LaneMask<W> operator==(Lanes a, Lanes b) { return {a.v == b.v}; }

  friend SPHPARAM_INLINE Lanes select(LaneMask<W> m, Lanes a, Lanes b) { return m.v ? a.v : b.v; }
  friend SPHPARAM_INLINE Lanes smaller(Lanes a, Lanes b) { return a.v < b.v ? a.v : b.v; }
  friend SPHPARAM_INLINE Lanes larger(Lanes a, Lanes b) { return a.v > b.v ? a.v : b.v; }
  friend SPHPARAM_INLINE Lanes magnitude(Lanes a) { return a.v < Vector{} ? -a.v : a.v; }
  /// Whether a < 0 or a is −0.
  friend SPHPARAM_INLINE LaneMask<W> sign_bit(Lanes a) {
    typename LaneMask<W>::Vector bits;
    __builtin_memcpy(&bits, &a.v, sizeof bits);
    return {bits < typename LaneMask<W>::Vector{}};
  }
  friend SPHPARAM_INLINE Lanes root(Lanes a) {
    for (int i = 0; i < W; ++i) a.v[i] = __builtin_sqrt(a.v[i]);
    return a;
  }
};

/// For templates that take single numbers too.
SPHPARAM_INLINE double root(double a) { return __builtin_sqrt(a); }
SPHPARAM_INLINE double select(bool m, double a, double b) { return m ? a : b; }

template <int W>
SPHPARAM_INLINE Lanes<W> load(const double* values) {
  typename Vectors<W>::Doubles r;
  __builtin_memcpy(&r, values, sizeof r);
  return r;
}
template <int W>
SPHPARAM_INLINE Lanes<W> load(const float* values) {
  typename Vectors<W>::Floats f;
  __builtin_memcpy(&f, values, sizeof f);
  return __builtin_convertvector(f, typename Vectors<W>::Doubles);
}
template <int W>
SPHPARAM_INLINE void store(Lanes<W> a, double* values) {
  __builtin_memcpy(values, &a.v, sizeof a.v);
}
template <int W>
SPHPARAM_INLINE void store(Lanes<W> a, float* values) {
  const auto f = __builtin_convertvector(a.v, typename Vectors<W>::Floats);
  __builtin_memcpy(values, &f, sizeof f);
}

/// W rays or points.
template <int W>
struct LaneVectors {
  Lanes<W> x, y, z;

  friend SPHPARAM_INLINE LaneVectors operator+(const LaneVectors& a, const LaneVectors& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend SPHPARAM_INLINE LaneVectors operator-(const LaneVectors& a, const LaneVectors& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend SPHPARAM_INLINE LaneVectors operator*(Lanes<W> s, const LaneVectors& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  friend SPHPARAM_INLINE Lanes<W> dot(const LaneVectors& a, const LaneVectors& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend SPHPARAM_INLINE LaneVectors cross(const LaneVectors& a, const LaneVectors& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend SPHPARAM_INLINE LaneVectors select(LaneMask<W> m, const LaneVectors& a,
                                            const LaneVectors& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
  }
  friend SPHPARAM_INLINE LaneVectors unit(const LaneVectors& a) {
    return (1.0 / root(dot(a, a))) * a;
  }
};

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

enum class InstructionSet { Baseline, Avx2, Avx512 };

/// The widest one of this machine, unless limited.
InstructionSet instruction_set();
/// For tests and benchmarks: nothing wider from now on.
void limit_instruction_set(InstructionSet widest);

template <int W>
using Width = std::integral_constant<int, W>;

#if defined(__x86_64__) && defined(__GNUC__)
template <class Work>
__attribute__((target("avx512f,avx512dq,avx512vl,avx512bw"))) void run_avx512(const Work& work) {
  work(Width<8>{});
}
template <class Work>
__attribute__((target("avx2"))) void run_avx2(const Work& work) {
  work(Width<4>{});
}
#endif

/// Calls work(Width<W>{}), compiled for the instruction set at hand. `work` must be
/// SPHPARAM_INLINED, and so must all be that it calls.
template <class Work>
void run_on_lanes(const Work& work) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (instruction_set() == InstructionSet::Avx512) return run_avx512(work);
  if (instruction_set() == InstructionSet::Avx2) return run_avx2(work);
#endif
  work(Width<2>{});
}

}  // namespace sphparam
