#pragma once

#include "embedding/energy/energy_terms.h"
#include "embedding/energy/gathered_lanes.h"
#include "embedding/energy/image_point.h"
#include "embedding/energy/orientation_guard.h"
#include "embedding/energy/triangle_packs.h"

namespace sphparam {

/// The energy A f of W triangles, one a lane, as a function of their six tangent coordinates; the
/// formulas are derived in distortion_energy.cpp, whose `triangle_energy` is this for one triangle
/// and for folded maps too.
template <int W>
struct TriangleDerivatives {
  using Lanes = sphparam::Lanes<W>;
  using LaneVectors = sphparam::LaneVectors<W>;

  /// `tangent_frame`, W at a time.
  static SPHPARAM_INLINE void frame(const LaneVectors& x, LaneVectors& u, LaneVectors& v) {
    const Lanes one = 1.0, sign = select(sign_bit(x.z), -one, one);
    const Lanes a = -1.0 / (sign + x.z), b = x.x * x.y * a;
    u = {one + sign * x.x * x.x * a, sign * b, -sign * x.x};
    v = {b, sign + x.y * x.y * a, -x.y};
  }

  /// The image: x0 and the edges from it, d and s.
  struct Image {
    LaneVectors x[3], a, b, j1, j2;
    Lanes d, s;
    LaneMask<W> certain;  // that s is positive
    Lanes base, height, foot, area;
    Lanes marked;  // the base, negative where the triangle is pressed
  };

  /// Lanes `first` … of a pack.
  template <class Terms>
  static SPHPARAM_INLINE Image measure(const Terms& energy, const TrianglePack& pack, int first,
                                       const ImagePoint* points) {
    Image m;
    for (int k = 0; k < 3; ++k) m.x[k] = gather<W>(points, pack.corner[k] + first);
    m.marked = load<W>(pack.inverse_base + first);
    m.base = energy.plain(m.marked);
    m.height = load<W>(pack.inverse_height + first);
    m.foot = load<W>(pack.foot + first);
    m.area = 0.5 / (m.base * m.height);
    m.a = m.x[1] - m.x[0];
    m.b = m.x[2] - m.x[0];
    m.j1 = m.base * m.a;
    m.j2 = m.height * (m.b - m.foot * m.a);
    m.d = 0.5 * (dot(m.j1, m.j1) + dot(m.j2, m.j2));
    const Lanes half_det = 0.5 * dot(m.x[0], cross(m.a, m.b));
    m.certain = certainly_positive(half_det, dot(m.a, m.a) + dot(m.b, m.b));
    m.s = half_det / m.area;
    return m;
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

  /// The exact Hessian of A f in the frames, and the gradient.
  template <class Terms>
  static SPHPARAM_INLINE void exact_hessian(const Terms& energy, const Image& m,
                                            const LaneVectors* u, const LaneVectors* v, Six* h,
                                            Lanes gradient[3][2]) {
    const EnergyTerms<Lanes> f = energy.triangle_terms(m.d, m.s, m.marked);
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
};

}  // namespace sphparam
