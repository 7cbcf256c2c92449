#pragma once

#include <algorithm>

#include "embedding/energy/triangle_derivatives.h"
#include "lanes.h"

// A triangle has six tangent coordinates; turning it about the centre changes nothing, so only
// three of them carry shape. Householder reflections turn the Hessian into a basis whose first
// three vectors are the infinitesimal rotations (two that carry the triangle along, one that turns
// it in its plane). In the three shape directions negative eigenvalues are raised; the turn in
// the plane keeps its curvature if that is positive; the other two rotations are dropped.
// Clamping all six eigenvalues instead is stiffer: more steps.

namespace sphparam {

/// Makes Hessians of W triangles positive semidefinite.
template <int W>
struct ShapeProjection {
  using Lanes = sphparam::Lanes<W>;
  using LaneVectors = sphparam::LaneVectors<W>;
  using Mask = LaneMask<W>;
  using Derivatives = TriangleDerivatives<W>;
  using Image = typename Derivatives::Image;
  using Six = typename Derivatives::Six;

  static constexpr double definite = 1e-9;  // least pivot, of the largest entry, left as it is
  // Eigenvalues are raised to this share of the largest entry.
  static constexpr double least_curvature = 1e-6;
  static constexpr int jacobi_sweeps = 4;  // quadratic convergence: full precision

  /// Orthonormal: two rotations dropped, `turn` in the triangle's plane, three shape directions.
  struct ShapeBasis {
    Six shape[3], turn;
  };

  /// a less its part along v, twice: scale is 2/|v|².
  static SPHPARAM_INLINE void reflect(const Six& v, Lanes scale, Six& a) {
    const Lanes f = scale * Derivatives::product(v, a);
    for (int i = 0; i < 6; ++i) a.c[i] -= f * v.c[i];
  }

  static SPHPARAM_INLINE ShapeBasis shape_basis(const Image& m, const LaneVectors* u,
                                                const LaneVectors* v) {
    // 1. Axes: two in the triangle's plane, and its centre. About that one velocities are taken
    // from
    //    differences: all three points move alike otherwise, up to rounding.
    LaneVectors centre = ((m.x[0] + m.x[1]) + m.x[2]), axis[3];
    centre = unit(centre);
    Derivatives::frame(centre, axis[0], axis[1]);
    axis[2] = centre;
    const Lanes third = 1.0 / 3;
    const LaneVectors mean = (third * (m.a + m.b));
    const Lanes size = 1.0 / root(dot(m.a, m.a) + dot(m.b, m.b));
    const LaneVectors from_mean[3] = {(-size * mean), (size * (m.a - mean)), (size * (m.b - mean))};
    // 2. QR of the three velocity fields in tangent coordinates, a Householder reflection a column.
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
    // 3. Columns 2 to 5 of Q: the turn in the plane, then what no rotation does.
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
    // 1. Which lanes are definite already: by their Cholesky pivots.
    const Lanes floor = definite * scale;
    const Lanes l1 = given.o01 / given.d[0], l2 = given.o02 / given.d[0];
    const Lanes p1 = given.d[1] - l1 * given.o01, q = given.o12 - l1 * given.o02;
    const Lanes p2 = given.d[2] - l2 * given.o02 - q * q / p1;
    const Mask fine = (given.d[0] > floor) & (p1 > floor) & (p2 > floor);
    if (!(~fine).any()) return given;

    // 2. Eigenvalues, onto a's diagonal, and eigenvectors, the columns of e, by cyclic sweeps.
    Lanes a[3][3] = {{given.d[0], given.o01, given.o02},
                     {given.o01, given.d[1], given.o12},
                     {given.o02, given.o12, given.d[2]}};
    Lanes e[3][3] = {{1.0, Lanes{}, Lanes{}}, {Lanes{}, 1.0, Lanes{}}, {Lanes{}, Lanes{}, 1.0}};
    for (int sweep = 0; sweep < jacobi_sweeps; ++sweep) {
      for (int pair = 0; pair < 3; ++pair) {
        const int i = pair == 2 ? 1 : 0, j = pair == 0 ? 1 : 2, k = 3 - i - j;
        // The rotation that makes a_ij zero; k is the third index.
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
    // 3. Put together again, eigenvalues raised where they are too small.
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

  /// What is left of the Hessians, by entries: Q C Qᵀ + turning · t tᵀ.
  struct Projected {
    ShapeBasis basis;
    Lanes qc[6][4];

    SPHPARAM_INLINE Lanes entry(int i, int j) const {
      return qc[i][0] * basis.shape[0].c[j] + qc[i][1] * basis.shape[1].c[j] +
             qc[i][2] * basis.shape[2].c[j] + qc[i][3] * basis.turn.c[j];
    }
  };

  /// h: rows of the Hessians of triangles whose corners have the frames u, v.
  static SPHPARAM_INLINE void project(const Six* h, const Image& m, const LaneVectors* u,
                                      const LaneVectors* v, Projected& result) {
    const ShapeBasis basis = result.basis = shape_basis(m, u, v);
    const auto product = [](const Six& a, const Six& b)
                             SPHPARAM_INLINED { return Derivatives::product(a, b); };
    const auto apply = [&](const Six& a) SPHPARAM_INLINED {
      Six r;
      for (int i = 0; i < 6; ++i) r.c[i] = product(h[i], a);
      return r;
    };
    // The Hessian in the shape directions, C = QᵀHQ, and its curvature along the turn.
    const Six hq[3] = {apply(basis.shape[0]), apply(basis.shape[1]), apply(basis.shape[2])};
    const Lanes turning = larger(Lanes{}, product(basis.turn, apply(basis.turn)));
    const Symmetric3 c =
        positive_part({{product(basis.shape[0], hq[0]), product(basis.shape[1], hq[1]),
                        product(basis.shape[2], hq[2])},
                       product(basis.shape[0], hq[1]),
                       product(basis.shape[0], hq[2]),
                       product(basis.shape[1], hq[2])});
    // QC and turning · t, whose products with Q and t the entries are.
    for (int i = 0; i < 6; ++i) {
      const Lanes q0 = basis.shape[0].c[i], q1 = basis.shape[1].c[i], q2 = basis.shape[2].c[i];
      result.qc[i][0] = q0 * c.d[0] + q1 * c.o01 + q2 * c.o02;
      result.qc[i][1] = q0 * c.o01 + q1 * c.d[1] + q2 * c.o12;
      result.qc[i][2] = q0 * c.o02 + q1 * c.o12 + q2 * c.d[2];
      result.qc[i][3] = turning * basis.turn.c[i];
    }
  }
};

}  // namespace sphparam
