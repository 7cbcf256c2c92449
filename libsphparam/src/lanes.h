#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "sphparam/mesh/triangle_mesh.h"

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

/// The number in each lane. By permutations: GCC 12 sets lane after lane where a vector is made of
/// scalars in a function that was not itself declared for vectors as wide.
template <int W>
SPHPARAM_INLINE typename Vectors<W>::Doubles all_lanes(double value) {
  const Vectors<2>::Doubles pair = {value, value};
  if constexpr (W == 2) return pair;
  if constexpr (W == 4) return __builtin_shufflevector(pair, pair, 0, 0, 0, 0);
  if constexpr (W == 8) {
    Vectors<8>::Doubles first{};
    first[0] = value;
    return __builtin_shufflevector(first, first, 0, 0, 0, 0, 0, 0, 0, 0);
  }
}

template <int W>
struct Lanes {
  using Vector = typename Vectors<W>::Doubles;
  Vector v;

  Lanes() = default;
  SPHPARAM_INLINE Lanes(Vector vector) : v(vector) {}
  SPHPARAM_INLINE Lanes(double value) : v(all_lanes<W>(value)) {}

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
SPHPARAM_INLINE double dot(const Vector3& a, const Vector3& b) { return a.dot(b); }
SPHPARAM_INLINE Vector3 cross(const Vector3& a, const Vector3& b) { return a.cross(b); }

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

/// Vectors i, i + 1, … of three tables.
template <int W, class Table>
SPHPARAM_INLINE LaneVectors<W> load(const std::array<Table, 3>& tables, std::size_t i) {
  return {load<W>(&tables[0][i]), load<W>(&tables[1][i]), load<W>(&tables[2][i])};
}

template <int W, class Table>
SPHPARAM_INLINE void store(const LaneVectors<W>& a, std::array<Table, 3>& tables, std::size_t i) {
  store(a.x, &tables[0][i]);
  store(a.y, &tables[1][i]);
  store(a.z, &tables[2][i]);
}
/// The same vector in each lane.
template <int W>
SPHPARAM_INLINE LaneVectors<W> all_lanes(const Vector3& a) {
  return {a.x(), a.y(), a.z()};
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
