#include "embedding/energy/triangle_packs.h"

#include <algorithm>
#include <limits>

#include "embedding/energy/energy_terms.h"
#include "embedding/energy/shape_projection.h"
#include "embedding/energy/triangle_derivatives.h"
#include "ieee_arithmetic.h"
#include "lanes.h"

// Energy, gradient and Hessian of eight triangles at a time.

namespace sphparam {
namespace {

template <int W, class Terms>
SPHPARAM_INLINE double sum_energy(const Terms& energy, const TrianglePack* packs, int count,
                                  const ImagePoint* points) {
  double total = 0;
  const int full = count / pack_width, rest = count % pack_width;
  for (int first = 0; first < pack_width; first += W) {
    Lanes<W> sum = 0.0;
    for (int p = 0; p < full + (rest > 0); ++p) {
      const auto m = TriangleDerivatives<W>::measure(energy, packs[p], first, points);
      if ((~m.certain).any()) return std::numeric_limits<double>::infinity();
      Lanes<W> e = m.area * energy.triangle_value(m.d, m.s, m.marked);
      if (p == full) {
        for (int i = std::max(0, rest - first); i < W; ++i) e.v[i] = 0;
      }
      sum += e;
    }
    for (int i = 0; i < W; ++i) total += sum[i];
  }
  return total;
}

/// Lanes `first` … of a pack. `entry(i, j)`: of their Hessians.
template <class Entry>
SPHPARAM_INLINE void store_hessian(const Entry& entry, int first, TriangleTerms& terms) {
  for (int k = 0; k < 3; ++k) {
    const int i = 2 * k, j = 2 * ((k + 1) % 3);
    store(entry(i, i), terms.diagonal[k][0] + first);
    store(entry(i, i + 1), terms.diagonal[k][1] + first);
    store(entry(i + 1, i + 1), terms.diagonal[k][2] + first);
    for (int e = 0; e < 4; ++e) store(entry(i + e / 2, j + e % 2), terms.off[k][e] + first);
  }
}

/// Lanes `first` … of a pack.
template <int W, class Terms>
SPHPARAM_INLINE void differentiate_part(const Terms& energy, const TrianglePack& pack, int first,
                                        const ImagePoint* points, Curvature curvature,
                                        TriangleTerms& terms) {
  using Derivatives = TriangleDerivatives<W>;
  const auto m = Derivatives::measure(energy, pack, first, points);
  LaneVectors<W> u[3], v[3];
  for (int k = 0; k < 3; ++k) Derivatives::frame(m.x[k], u[k], v[k]);
  typename Derivatives::Six h[6];
  Lanes<W> gradient[3][2];
  Derivatives::exact_hessian(energy, m, u, v, h, gradient);
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 2; ++i) store(gradient[k][i], terms.gradient[k][i] + first);
  }
  if (curvature == Curvature::Exact) {
    return store_hessian([&](int i, int j) SPHPARAM_INLINED { return h[i].c[j]; }, first, terms);
  }
  typename ShapeProjection<W>::Projected projected;
  ShapeProjection<W>::project(h, m, u, v, projected);
  store_hessian([&](int i, int j) SPHPARAM_INLINED { return projected.entry(i, j); }, first, terms);
}

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
  return with_terms_of(energy, [&](const auto& terms) {
    double sum = 0;
    run_on_lanes([&]<int W>(Width<W>)
                     SPHPARAM_INLINED { sum = sum_energy<W>(terms, packs, count, points); });
    return sum;
  });
}

void differentiate_triangles(const TrianglePack* packs, int count, const ImagePoint* points,
                             const DistortionEnergy& energy, Curvature curvature,
                             TriangleTerms* terms) {
  with_terms_of(energy, [&](const auto& energy_terms) {
    run_on_lanes([&]<int W>(Width<W>) SPHPARAM_INLINED {
      for (int p = 0; p < count; ++p) {
        for (int first = 0; first < pack_width; first += W) {
          differentiate_part<W>(energy_terms, packs[p], first, points, curvature, terms[p]);
        }
      }
    });
  });
}

}  // namespace sphparam
