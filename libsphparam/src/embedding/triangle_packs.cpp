#include "embedding/triangle_packs.h"

// Energy, gradient and projected Hessian of eight triangles at a time; the formulas are those of
// distortion_energy.cpp, the guard is that of pack_kernel.cpp.
//
// A triangle has six tangent coordinates; turning it about the centre changes nothing, so only
// three of them carry shape. Householder reflections turn the Hessian into a basis whose first
// three vectors are the infinitesimal rotations (two that carry the triangle along, one that turns
// it in its plane). In the three shape directions negative eigenvalues are raised; the turn in
// the plane keeps its curvature if that is positive; the other two rotations are dropped.
// Clamping all six eigenvalues instead is stiffer: more steps.

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define SPHPARAM_MULTIVERSION __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SPHPARAM_MULTIVERSION
#endif
#define SPHPARAM_INLINE inline __attribute__((always_inline))

#include <limits>

namespace sphparam {
namespace {

using Mask = long long __attribute__((vector_size(8 * pack_width)));  // −1 true, 0 false

constexpr double guard_margin = 1e-14;    // see pack_kernel.cpp
constexpr double definite = 1e-9;         // least pivot, of the largest entry, left as it is
constexpr double least_curvature = 1e-6;  // of the largest entry: what eigenvalues are raised to
constexpr int jacobi_sweeps = 4;          // quadratic convergence: full precision

SPHPARAM_INLINE Lanes splat(double value) { return value - Lanes{}; }
SPHPARAM_INLINE Lanes root(Lanes a) {
  for (int i = 0; i < pack_width; ++i) a[i] = __builtin_sqrt(a[i]);
  return a;
}
SPHPARAM_INLINE bool any(Mask m) {
  long long bits = 0;
  for (int i = 0; i < pack_width; ++i) bits |= m[i];
  return bits != 0;
}
SPHPARAM_INLINE Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }
SPHPARAM_INLINE Lanes magnitude(Lanes a) { return a < Lanes{} ? -a : a; }
SPHPARAM_INLINE Lanes load(const double* values) {
  Lanes r;
  __builtin_memcpy(&r, values, sizeof r);
  return r;
}

SPHPARAM_INLINE Lanes dot(const LaneVectors& a, const LaneVectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
SPHPARAM_INLINE LaneVectors plus(const LaneVectors& a, const LaneVectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
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

/// `tangent_frame`, eight at a time.
SPHPARAM_INLINE void frame(const LaneVectors& x, LaneVectors& u, LaneVectors& v) {
  Mask negative;
  __builtin_memcpy(&negative, &x.z, sizeof negative);
  const Lanes one = splat(1), sign = negative < Mask{} ? -one : one;
  const Lanes a = -1.0 / (sign + x.z), b = x.x * x.y * a;
  u = {one + sign * x.x * x.x * a, sign * b, -sign * x.x};
  v = {b, sign + x.y * x.y * a, -x.y};
}

struct Derivatives {
  Lanes f, f_d, f_s, f_ds, f_ss;
};

/// f = (d + λ(s² + 1)/2) / s
struct AngleAndArea {
  double lambda;
  SPHPARAM_INLINE Lanes value(Lanes d, Lanes s) const {
    return (d + 0.5 * lambda * (s * s + 1.0)) / s;
  }
  SPHPARAM_INLINE Derivatives derivatives(Lanes d, Lanes s) const {
    const Lanes i = 1.0 / s, f = (d + 0.5 * lambda * (s * s + 1.0)) * i;
    return {f, i, lambda - f * i, -i * i, (2.0 * f * i - lambda) * i};
  }
};

/// f = d (1 + 1/s²)
struct SymmetricDirichlet {
  SPHPARAM_INLINE Lanes value(Lanes d, Lanes s) const { return d + d / (s * s); }
  SPHPARAM_INLINE Derivatives derivatives(Lanes d, Lanes s) const {
    const Lanes i = 1.0 / s, ii = i * i;
    return {d + d * ii, 1.0 + ii, -2.0 * d * ii * i, -2.0 * ii * i, 6.0 * d * ii * ii};
  }
};

/// The image: x0 and the edges from it, d and s.
struct Image {
  LaneVectors x[3], a, b, j1, j2;
  Lanes d, s, certainty;  // s is certain to be positive where certainty > 0
  Lanes base, height, foot, area;
};

SPHPARAM_INLINE Image measure(const TrianglePack& pack, const ImagePoint* points) {
  Image m;
  for (int k = 0; k < 3; ++k) m.x[k] = gather(points, pack.corner[k]);
  m.base = load(pack.inverse_base);
  m.height = load(pack.inverse_height);
  m.foot = load(pack.foot);
  m.area = load(pack.area);
  m.a = minus(m.x[1], m.x[0]);
  m.b = minus(m.x[2], m.x[0]);
  m.j1 = times(m.base, m.a);
  m.j2 = times(m.height, minus(m.b, times(m.foot, m.a)));
  m.d = 0.5 * (dot(m.j1, m.j1) + dot(m.j2, m.j2));
  const Lanes half_det = 0.5 * dot(m.x[0], cross(m.a, m.b));
  m.certainty = half_det - guard_margin * (dot(m.a, m.a) + dot(m.b, m.b));
  m.s = half_det / m.area;
  return m;
}

template <class Energy>
SPHPARAM_INLINE double sum_energy(const Energy& energy, const TrianglePack* packs, int count,
                                  const ImagePoint* points) {
  Lanes sum{};
  for (int p = 0; p < count; ++p) {
    const Image m = measure(packs[p], points);
    if (any(~(m.certainty > Lanes{}))) return std::numeric_limits<double>::infinity();
    Lanes e = m.area * energy.value(m.d, m.s);
    for (int i = packs[p].filled; i < pack_width; ++i) e[i] = 0;
    sum += e;
  }
  double total = 0;
  for (int i = 0; i < pack_width; ++i) total += sum[i];
  return total;
}

/// A vector of the six tangent coordinates.
struct Six {
  Lanes c[6];
};

SPHPARAM_INLINE Lanes dot(const Six& a, const Six& b) {
  Lanes r = a.c[0] * b.c[0];
  for (int i = 1; i < 6; ++i) r += a.c[i] * b.c[i];
  return r;
}

/// Orthonormal: two rotations dropped, `turn` in the triangle's plane, three shape directions.
struct ShapeBasis {
  Six shape[3], turn;
};

SPHPARAM_INLINE void reflect(const Six& v, Lanes scale, Six& a) {
  const Lanes f = scale * dot(v, a);
  for (int i = 0; i < 6; ++i) a.c[i] -= f * v.c[i];
}

SPHPARAM_INLINE ShapeBasis shape_basis(const Image& m, const LaneVectors* u, const LaneVectors* v) {
  // Rotations about two axes in the plane and, from differences, about the centre.
  LaneVectors centre = plus(plus(m.x[0], m.x[1]), m.x[2]), axis[3];
  centre = times(1.0 / root(dot(centre, centre)), centre);
  frame(centre, axis[0], axis[1]);
  axis[2] = centre;
  const Lanes third = splat(1.0 / 3);
  const LaneVectors mean = times(third, plus(m.a, m.b));
  const Lanes size = 1.0 / root(dot(m.a, m.a) + dot(m.b, m.b));
  const LaneVectors from_mean[3] = {times(-size, mean), times(size, minus(m.a, mean)),
                                    times(size, minus(m.b, mean))};
  Six reflector[3];
  Lanes scale[3];
  for (int r = 0; r < 3; ++r) {
    Six column;
    for (int k = 0; k < 3; ++k) {
      const LaneVectors velocity = cross(axis[r], r < 2 ? m.x[k] : from_mean[k]);
      column.c[2 * k] = dot(velocity, u[k]);
      column.c[2 * k + 1] = dot(velocity, v[k]);
    }
    for (int q = 0; q < r; ++q) reflect(reflector[q], scale[q], column);
    Lanes squares{};
    for (int i = r; i < 6; ++i) squares += column.c[i] * column.c[i];
    const Lanes length = root(squares), pivot = column.c[r];
    for (int i = 0; i < r; ++i) column.c[i] = Lanes{};
    column.c[r] = pivot < Lanes{} ? pivot - length : pivot + length;
    const Lanes norm2 = squares + length * magnitude(pivot);  // ½|column|²
    scale[r] = norm2 > Lanes{} ? 1.0 / norm2 : Lanes{};
    reflector[r] = column;
  }
  ShapeBasis basis;
  for (int j = 0; j < 4; ++j) {
    Six e{};
    e.c[2 + j] = splat(1);
    for (int r = 2; r >= 0; --r) reflect(reflector[r], scale[r], e);
    (j == 0 ? basis.turn : basis.shape[j - 1]) = e;
  }
  return basis;
}

/// A symmetric 3×3 matrix: 00 11 22 01 02 12.
struct Symmetric3 {
  Lanes d[3], o01, o02, o12;
};

/// Raises the eigenvalues of the lanes that are not definite, by cyclic Jacobi rotations.
SPHPARAM_INLINE Symmetric3 positive_part(const Symmetric3& given) {
  Lanes scale = Lanes{};
  for (const Lanes& e : {given.d[0], given.d[1], given.d[2], given.o01, given.o02, given.o12}) {
    scale = larger(scale, magnitude(e));
  }
  // Cholesky pivots
  const Lanes floor = definite * scale;
  const Lanes l1 = given.o01 / given.d[0], l2 = given.o02 / given.d[0];
  const Lanes p1 = given.d[1] - l1 * given.o01, q = given.o12 - l1 * given.o02;
  const Lanes p2 = given.d[2] - l2 * given.o02 - q * q / p1;
  const Mask fine = (given.d[0] > floor) & (p1 > floor) & (p2 > floor);
  if (!any(~fine)) return given;

  Lanes a[3][3] = {{given.d[0], given.o01, given.o02},
                   {given.o01, given.d[1], given.o12},
                   {given.o02, given.o12, given.d[2]}};
  Lanes e[3][3] = {
      {splat(1), Lanes{}, Lanes{}}, {Lanes{}, splat(1), Lanes{}}, {Lanes{}, Lanes{}, splat(1)}};
  for (int sweep = 0; sweep < jacobi_sweeps; ++sweep) {
    for (int pair = 0; pair < 3; ++pair) {
      const int i = pair == 2 ? 1 : 0, j = pair == 0 ? 1 : 2, k = 3 - i - j;
      const Lanes theta = (a[j][j] - a[i][i]) / (2.0 * a[i][j]);
      const Lanes size = 1.0 / (magnitude(theta) + root(theta * theta + 1.0));
      Lanes t = theta < Lanes{} ? -size : size;
      t = a[i][j] == Lanes{} ? Lanes{} : t;
      const Lanes c = 1.0 / root(t * t + 1.0), s = t * c;
      a[i][i] -= t * a[i][j];
      a[j][j] += t * a[i][j];
      a[i][j] = a[j][i] = Lanes{};
      const Lanes ki = a[k][i], kj = a[k][j];
      a[k][i] = a[i][k] = c * ki - s * kj;
      a[k][j] = a[j][k] = s * ki + c * kj;
      for (int r = 0; r < 3; ++r) {
        const Lanes ei = e[r][i], ej = e[r][j];
        e[r][i] = c * ei - s * ej;
        e[r][j] = s * ei + c * ej;
      }
    }
  }
  const Lanes least = least_curvature * scale;
  const auto entry = [&](int r, int c, Lanes before) __attribute__((always_inline)) {
    Lanes sum{};
    for (int i = 0; i < 3; ++i) sum += e[r][i] * larger(least, a[i][i]) * e[c][i];
    return fine ? before : sum;
  };
  return {{entry(0, 0, given.d[0]), entry(1, 1, given.d[1]), entry(2, 2, given.d[2])},
          entry(0, 1, given.o01),
          entry(0, 2, given.o02),
          entry(1, 2, given.o12)};
}

/// The exact Hessian of A f in the frames, and the gradient.
template <class Energy>
SPHPARAM_INLINE void exact_hessian(const Energy& energy, const Image& m, const LaneVectors* u,
                                   const LaneVectors* v, Six* h, Lanes gradient[3][2]) {
  const Derivatives f = energy.derivatives(m.d, m.s);
  const Lanes f_d = m.area * f.f_d, f_s = m.area * f.f_s, f_ds = m.area * f.f_ds,
              f_ss = m.area * f.f_ss, inverse = 0.5 / m.area;
  // L = ggᵀ + kkᵀ
  const Lanes g[3] = {-m.base, m.base, Lanes{}};
  const Lanes k[3] = {(m.foot - 1.0) * m.height, -m.foot * m.height, m.height};
  const LaneVectors zero{Lanes{}, Lanes{}, Lanes{}};
  const LaneVectors edge[3] = {minus(m.b, m.a), minus(zero, m.b), m.a};  // opposite the corner
  Six d_tau, s_tau;
  Lanes isotropic[3];
  for (int i = 0; i < 3; ++i) {
    const LaneVectors d_x = plus(times(g[i], m.j1), times(k[i], m.j2));
    const LaneVectors s_x = times(inverse, cross(m.x[(i + 1) % 3], edge[i]));
    d_tau.c[2 * i] = dot(d_x, u[i]);
    d_tau.c[2 * i + 1] = dot(d_x, v[i]);
    s_tau.c[2 * i] = dot(s_x, u[i]);
    s_tau.c[2 * i + 1] = dot(s_x, v[i]);
    for (int p = 0; p < 2; ++p) {
      gradient[i][p] = f_d * d_tau.c[2 * i + p] + f_s * s_tau.c[2 * i + p];
    }
    isotropic[i] = f_d * (g[i] * g[i] + k[i] * k[i] - dot(d_x, m.x[i])) - f_s * m.s;
  }
  // f_ds(∇d∇sᵀ + ∇s∇dᵀ) + f_ss ∇s∇sᵀ
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      h[i].c[j] = f_ds * (d_tau.c[i] * s_tau.c[j] + s_tau.c[i] * d_tau.c[j]) +
                  f_ss * (s_tau.c[i] * s_tau.c[j]);
    }
  }
  // f_d ∇²d + f_s ∇²s; on the diagonal less the normal slope
  for (int i = 0; i < 3; ++i) {
    h[2 * i].c[2 * i] += isotropic[i];
    h[2 * i + 1].c[2 * i + 1] += isotropic[i];
    for (int j = 0; j < i; ++j) {
      const Lanes l = f_d * (g[i] * g[j] + k[i] * k[j]);
      const bool cyclic = (i + 1) % 3 == j;
      const Lanes q = cyclic ? f_s * inverse : -f_s * inverse;
      const LaneVectors& x = m.x[3 - i - j];
      for (int b = 0; b < 2; ++b) {
        const LaneVectors& tau = b == 0 ? u[j] : v[j];
        const LaneVectors w = plus(times(l, tau), times(q, cross(tau, x)));
        h[2 * i].c[2 * j + b] += dot(u[i], w);
        h[2 * i + 1].c[2 * j + b] += dot(v[i], w);
      }
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) h[i].c[j] = h[j].c[i];
  }
}

template <class Energy>
SPHPARAM_INLINE void differentiate_pack(const Energy& energy, const TrianglePack& pack,
                                        const ImagePoint* points, TriangleTerms& terms) {
  const Image m = measure(pack, points);
  LaneVectors u[3], v[3];
  for (int k = 0; k < 3; ++k) frame(m.x[k], u[k], v[k]);
  Six h[6];
  exact_hessian(energy, m, u, v, h, terms.gradient);
  const ShapeBasis basis = shape_basis(m, u, v);
  const auto apply = [&](const Six& a) __attribute__((always_inline)) {
    Six r;
    for (int i = 0; i < 6; ++i) r.c[i] = dot(h[i], a);
    return r;
  };
  const Six hq[3] = {apply(basis.shape[0]), apply(basis.shape[1]), apply(basis.shape[2])};
  const Lanes turning = larger(Lanes{}, dot(basis.turn, apply(basis.turn)));
  const Symmetric3 c = positive_part(
      {{dot(basis.shape[0], hq[0]), dot(basis.shape[1], hq[1]), dot(basis.shape[2], hq[2])},
       dot(basis.shape[0], hq[1]),
       dot(basis.shape[0], hq[2]),
       dot(basis.shape[1], hq[2])});
  // Q C Qᵀ + turning · t tᵀ
  Lanes qc[6][4];
  for (int i = 0; i < 6; ++i) {
    const Lanes q0 = basis.shape[0].c[i], q1 = basis.shape[1].c[i], q2 = basis.shape[2].c[i];
    qc[i][0] = q0 * c.d[0] + q1 * c.o01 + q2 * c.o02;
    qc[i][1] = q0 * c.o01 + q1 * c.d[1] + q2 * c.o12;
    qc[i][2] = q0 * c.o02 + q1 * c.o12 + q2 * c.d[2];
    qc[i][3] = turning * basis.turn.c[i];
  }
  const auto entry = [&](int i, int j) __attribute__((always_inline)) {
    return qc[i][0] * basis.shape[0].c[j] + qc[i][1] * basis.shape[1].c[j] +
           qc[i][2] * basis.shape[2].c[j] + qc[i][3] * basis.turn.c[j];
  };
  for (int k = 0; k < 3; ++k) {
    const int i = 2 * k, j = 2 * ((k + 1) % 3);
    terms.diagonal[k][0] = entry(i, i);
    terms.diagonal[k][1] = entry(i, i + 1);
    terms.diagonal[k][2] = entry(i + 1, i + 1);
    terms.off[k][0] = entry(i, j);
    terms.off[k][1] = entry(i, j + 1);
    terms.off[k][2] = entry(i + 1, j);
    terms.off[k][3] = entry(i + 1, j + 1);
  }
}

}  // namespace

SPHPARAM_MULTIVERSION
double guarded_energy(const TrianglePack* packs, int count, const ImagePoint* points,
                      const DistortionEnergy& energy) {
  if (energy.kind == EnergyKind::SymmetricDirichlet) {
    return sum_energy(SymmetricDirichlet{}, packs, count, points);
  }
  return sum_energy(AngleAndArea{energy.lambda}, packs, count, points);
}

SPHPARAM_MULTIVERSION
void differentiate_triangles(const TrianglePack* packs, int count, const ImagePoint* points,
                             const DistortionEnergy& energy, TriangleTerms* terms) {
  if (energy.kind == EnergyKind::SymmetricDirichlet) {
    for (int p = 0; p < count; ++p) {
      differentiate_pack(SymmetricDirichlet{}, packs[p], points, terms[p]);
    }
    return;
  }
  for (int p = 0; p < count; ++p) {
    differentiate_pack(AngleAndArea{energy.lambda}, packs[p], points, terms[p]);
  }
}

}  // namespace sphparam
