#include "embedding/energy/triangle_packs.h"

#include <algorithm>
#include <limits>

#include "embedding/energy/lanes.h"

// Energy, gradient and projected Hessian of eight triangles at a time; the formulas are those of
// distortion_energy.cpp, the guard is that of pack_kernel.cpp.
//
// A triangle has six tangent coordinates; turning it about the centre changes nothing, so only
// three of them carry shape. Householder reflections turn the Hessian into a basis whose first
// three vectors are the infinitesimal rotations (two that carry the triangle along, one that turns
// it in its plane). In the three shape directions negative eigenvalues are raised; the turn in
// the plane keeps its curvature if that is positive; the other two rotations are dropped.
// Clamping all six eigenvalues instead is stiffer: more steps.

namespace sphparam {
namespace {

constexpr double guard_margin = 1e-14, guard_least = 1e-290;  // see pack_kernel.cpp
constexpr double definite = 1e-9;         // least pivot, of the largest entry, left as it is
constexpr double least_curvature = 1e-6;  // of the largest entry: what eigenvalues are raised to
constexpr int jacobi_sweeps = 4;          // quadratic convergence: full precision

/// The kernel for W lanes of a pack.
template <int W>
struct Kernel {
  using Lanes = sphparam::Lanes<W>;
  using LaneVectors = sphparam::LaneVectors<W>;
  using Mask = LaneMask<W>;

  /// `tangent_frame`, W at a time.
  static SPHPARAM_INLINE void frame(const LaneVectors& x, LaneVectors& u, LaneVectors& v) {
    const Lanes one = 1.0, sign = select(sign_bit(x.z), -one, one);
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

  /// Lanes `first` … of a pack.
  static SPHPARAM_INLINE Image measure(const TrianglePack& pack, int first,
                                       const ImagePoint* points) {
    Image m;
    for (int k = 0; k < 3; ++k) m.x[k] = gather<W>(points, pack.corner[k] + first);
    m.base = load<W>(pack.inverse_base + first);
    m.height = load<W>(pack.inverse_height + first);
    m.foot = load<W>(pack.foot + first);
    m.area = 0.5 / (m.base * m.height);
    m.a = m.x[1] - m.x[0];
    m.b = m.x[2] - m.x[0];
    m.j1 = m.base * m.a;
    m.j2 = m.height * (m.b - m.foot * m.a);
    m.d = 0.5 * (dot(m.j1, m.j1) + dot(m.j2, m.j2));
    const Lanes half_det = 0.5 * dot(m.x[0], cross(m.a, m.b));
    m.certainty = half_det - guard_margin * (dot(m.a, m.a) + dot(m.b, m.b));
    m.s = half_det / m.area;
    return m;
  }

  template <class Energy>
  static SPHPARAM_INLINE double sum_energy(const Energy& energy, const TrianglePack* packs,
                                           int count, const ImagePoint* points) {
    double total = 0;
    const int full = count / pack_width, rest = count % pack_width;
    for (int first = 0; first < pack_width; first += W) {
      Lanes sum = 0.0;
      for (int p = 0; p < full + (rest > 0); ++p) {
        const Image m = measure(packs[p], first, points);
        if ((~(m.certainty > guard_least)).any()) return std::numeric_limits<double>::infinity();
        Lanes e = m.area * energy.value(m.d, m.s);
        if (p == full) {
          for (int i = std::max(0, rest - first); i < W; ++i) e.v[i] = 0;
        }
        sum += e;
      }
      for (int i = 0; i < W; ++i) total += sum[i];
    }
    return total;
  }

  /// A vector of the six tangent coordinates.
  struct Six {
    Lanes c[6];
  };

  static SPHPARAM_INLINE Lanes product(const Six& a, const Six& b) {
    Lanes r = a.c[0] * b.c[0];
    for (int i = 1; i < 6; ++i) r += a.c[i] * b.c[i];
    return r;
  }

  /// Orthonormal: two rotations dropped, `turn` in the triangle's plane, three shape directions.
  struct ShapeBasis {
    Six shape[3], turn;
  };

  static SPHPARAM_INLINE void reflect(const Six& v, Lanes scale, Six& a) {
    const Lanes f = scale * product(v, a);
    for (int i = 0; i < 6; ++i) a.c[i] -= f * v.c[i];
  }

  static SPHPARAM_INLINE ShapeBasis shape_basis(const Image& m, const LaneVectors* u,
                                                const LaneVectors* v) {
    // Rotations about two axes in the plane and, from differences, about the centre.
    LaneVectors centre = ((m.x[0] + m.x[1]) + m.x[2]), axis[3];
    centre = unit(centre);
    frame(centre, axis[0], axis[1]);
    axis[2] = centre;
    const Lanes third = 1.0 / 3;
    const LaneVectors mean = (third * (m.a + m.b));
    const Lanes size = 1.0 / root(dot(m.a, m.a) + dot(m.b, m.b));
    const LaneVectors from_mean[3] = {(-size * mean), (size * (m.a - mean)), (size * (m.b - mean))};
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
      column.c[r] = select(pivot < 0.0, pivot - length, pivot + length);
      const Lanes norm2 = squares + length * magnitude(pivot);  // ½|column|²
      scale[r] = select(norm2 > 0.0, 1.0 / norm2, Lanes(0.0));
      reflector[r] = column;
    }
    ShapeBasis basis;
    for (int j = 0; j < 4; ++j) {
      Six e{};
      e.c[2 + j] = 1.0;
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
  static SPHPARAM_INLINE Symmetric3 positive_part(const Symmetric3& given) {
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
    if (!(~fine).any()) return given;

    Lanes a[3][3] = {{given.d[0], given.o01, given.o02},
                     {given.o01, given.d[1], given.o12},
                     {given.o02, given.o12, given.d[2]}};
    Lanes e[3][3] = {{1.0, Lanes{}, Lanes{}}, {Lanes{}, 1.0, Lanes{}}, {Lanes{}, Lanes{}, 1.0}};
    for (int sweep = 0; sweep < jacobi_sweeps; ++sweep) {
      for (int pair = 0; pair < 3; ++pair) {
        const int i = pair == 2 ? 1 : 0, j = pair == 0 ? 1 : 2, k = 3 - i - j;
        const Lanes theta = (a[j][j] - a[i][i]) / (2.0 * a[i][j]);
        const Lanes size = 1.0 / (magnitude(theta) + root(theta * theta + 1.0));
        Lanes t = select(theta < 0.0, -size, size);
        t = select(a[i][j] == 0.0, Lanes(0.0), t);
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
    const auto entry = [&](int r, int c, Lanes before) SPHPARAM_INLINED {
      Lanes sum{};
      for (int i = 0; i < 3; ++i) sum += e[r][i] * larger(least, a[i][i]) * e[c][i];
      return select(fine, before, sum);
    };
    return {{entry(0, 0, given.d[0]), entry(1, 1, given.d[1]), entry(2, 2, given.d[2])},
            entry(0, 1, given.o01),
            entry(0, 2, given.o02),
            entry(1, 2, given.o12)};
  }

  /// The exact Hessian of A f in the frames, and the gradient.
  template <class Energy>
  static SPHPARAM_INLINE void exact_hessian(const Energy& energy, const Image& m,
                                            const LaneVectors* u, const LaneVectors* v, Six* h,
                                            Lanes gradient[3][2]) {
    const Derivatives f = energy.derivatives(m.d, m.s);
    const Lanes f_d = m.area * f.f_d, f_s = m.area * f.f_s, f_ds = m.area * f.f_ds,
                f_ss = m.area * f.f_ss, inverse = 0.5 / m.area;
    // L = ggᵀ + kkᵀ
    const Lanes g[3] = {-m.base, m.base, Lanes{}};
    const Lanes k[3] = {(m.foot - 1.0) * m.height, -m.foot * m.height, m.height};
    const LaneVectors zero{0.0, 0.0, 0.0};
    const LaneVectors edge[3] = {(m.b - m.a), (zero - m.b), m.a};  // opposite the corner
    Six d_tau, s_tau;
    Lanes isotropic[3];
    for (int i = 0; i < 3; ++i) {
      const LaneVectors d_x = g[i] * m.j1 + k[i] * m.j2;
      const LaneVectors s_x = inverse * cross(m.x[(i + 1) % 3], edge[i]);
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
          const LaneVectors w = ((l * tau) + (q * cross(tau, x)));
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
  static SPHPARAM_INLINE void differentiate_part(const Energy& energy, const TrianglePack& pack,
                                                 int first, const ImagePoint* points,
                                                 TriangleTerms& terms) {
    const Image m = measure(pack, first, points);
    LaneVectors u[3], v[3];
    for (int k = 0; k < 3; ++k) frame(m.x[k], u[k], v[k]);
    Six h[6];
    Lanes gradient[3][2];
    exact_hessian(energy, m, u, v, h, gradient);
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 2; ++i) store(gradient[k][i], terms.gradient[k][i] + first);
    }
    const ShapeBasis basis = shape_basis(m, u, v);
    const auto apply = [&](const Six& a) SPHPARAM_INLINED {
      Six r;
      for (int i = 0; i < 6; ++i) r.c[i] = product(h[i], a);
      return r;
    };
    const Six hq[3] = {apply(basis.shape[0]), apply(basis.shape[1]), apply(basis.shape[2])};
    const Lanes turning = larger(Lanes{}, product(basis.turn, apply(basis.turn)));
    const Symmetric3 c =
        positive_part({{product(basis.shape[0], hq[0]), product(basis.shape[1], hq[1]),
                        product(basis.shape[2], hq[2])},
                       product(basis.shape[0], hq[1]),
                       product(basis.shape[0], hq[2]),
                       product(basis.shape[1], hq[2])});
    // Q C Qᵀ + turning · t tᵀ
    Lanes qc[6][4];
    for (int i = 0; i < 6; ++i) {
      const Lanes q0 = basis.shape[0].c[i], q1 = basis.shape[1].c[i], q2 = basis.shape[2].c[i];
      qc[i][0] = q0 * c.d[0] + q1 * c.o01 + q2 * c.o02;
      qc[i][1] = q0 * c.o01 + q1 * c.d[1] + q2 * c.o12;
      qc[i][2] = q0 * c.o02 + q1 * c.o12 + q2 * c.d[2];
      qc[i][3] = turning * basis.turn.c[i];
    }
    const auto entry = [&](int i, int j) SPHPARAM_INLINED {
      return qc[i][0] * basis.shape[0].c[j] + qc[i][1] * basis.shape[1].c[j] +
             qc[i][2] * basis.shape[2].c[j] + qc[i][3] * basis.turn.c[j];
    };
    for (int k = 0; k < 3; ++k) {
      const int i = 2 * k, j = 2 * ((k + 1) % 3);
      store(entry(i, i), terms.diagonal[k][0] + first);
      store(entry(i, i + 1), terms.diagonal[k][1] + first);
      store(entry(i + 1, i + 1), terms.diagonal[k][2] + first);
      for (int e = 0; e < 4; ++e) store(entry(i + e / 2, j + e % 2), terms.off[k][e] + first);
    }
  }

  template <class Energy>
  static SPHPARAM_INLINE void differentiate(const Energy& energy, const TrianglePack* packs,
                                            int count, const ImagePoint* points,
                                            TriangleTerms* terms) {
    for (int p = 0; p < count; ++p) {
      for (int first = 0; first < pack_width; first += W) {
        differentiate_part(energy, packs[p], first, points, terms[p]);
      }
    }
  }
};

}  // namespace

void fill_lane(const RestTriangle& source, const std::array<Vertex, 3>& corners, int lane,
               TrianglePack& pack) {
  pack.inverse_base[lane] = static_cast<float>(source.inverse_base);
  pack.inverse_height[lane] = static_cast<float>(source.inverse_height);
  pack.foot[lane] = static_cast<float>(source.foot);
  for (size_t k = 0; k < 3; ++k) pack.corner[k][lane] = corners[k];
}

double guarded_energy(const TrianglePack* packs, int count, const ImagePoint* points,
                      const DistortionEnergy& energy) {
  double sum = 0;
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    using K = Kernel<W>;
    sum = energy.kind == EnergyKind::SymmetricDirichlet
              ? K::sum_energy(typename K::SymmetricDirichlet{}, packs, count, points)
              : K::sum_energy(typename K::AngleAndArea{energy.lambda}, packs, count, points);
  });
  return sum;
}

void differentiate_triangles(const TrianglePack* packs, int count, const ImagePoint* points,
                             const DistortionEnergy& energy, TriangleTerms* terms) {
  run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
    using K = Kernel<W>;
    if (energy.kind == EnergyKind::SymmetricDirichlet) {
      K::differentiate(typename K::SymmetricDirichlet{}, packs, count, points, terms);
    } else {
      K::differentiate(typename K::AngleAndArea{energy.lambda}, packs, count, points, terms);
    }
  });
}

}  // namespace sphparam
