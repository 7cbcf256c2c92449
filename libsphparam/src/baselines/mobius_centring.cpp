#include "baselines/mobius_centring.h"

#include <vector>

#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/parallel.h"

// The translation x → (1 − |a|²)(x − a)/|x − a|² − a moves x by −2a + 2(a·x)x to first order, so
// the centre of mass c moves by −2 Σ m (I − x xᵀ) a = −J a. A Newton step takes a = J⁻¹ c; it is
// halved until |c| falls.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;
constexpr double centred = 1e-10;  // |c| that is good enough
constexpr double longest = 0.9;    // step in the ball

struct Moments {
  Vector3 centre = Vector3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // Σ m x xᵀ
};

/// Of the points translated by a. Partial sums in fixed chunks.
Moments moments(const Points& points, const VectorX& mass, const Vector3& a, int threads) {
  std::vector<Moments> parts(static_cast<size_t>((points.rows() + grain - 1) / grain));
  parallel_for(points.rows(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    Moments& part = parts[static_cast<size_t>(first / grain)];
    for (Eigen::Index v = first; v < last; ++v) {
      const Vector3 x = mobius_translated(points.row(v), a);
      part.centre += mass[v] * x;
      part.second += mass[v] * x * x.transpose();
    }
  });
  Moments sum;
  for (const Moments& part : parts) {
    sum.centre += part.centre;
    sum.second += part.second;
  }
  return sum;
}

}  // namespace

Vector3 mobius_translated(const Vector3& x, const Vector3& a) {
  const Vector3 d = x - a;
  const double length2 = d.squaredNorm();
  if (!(length2 > 0)) return x;
  return ((1 - a.squaredNorm()) / length2 * d - a).normalized();
}

SphereMap mobius_centred(SphereMap map, const VectorX& mass, int max_steps, int threads) {
  const double total = mass.sum();
  if (!(total > 0)) return map;
  Moments now = moments(map.points, mass, Vector3::Zero(), threads);
  for (int step = 0; step < max_steps && now.centre.norm() > centred * total; ++step) {
    const Eigen::Matrix3d jacobian =
        2 * (now.second.trace() * Eigen::Matrix3d::Identity() - now.second);
    Vector3 a = jacobian.ldlt().solve(now.centre);
    if (!a.allFinite()) a = 0.5 * now.centre / total;
    if (a.norm() > longest) a *= longest / a.norm();
    Moments next = moments(map.points, mass, a, threads);
    while (!(next.centre.norm() < now.centre.norm()) && a.norm() > centred) {
      a /= 2;
      next = moments(map.points, mass, a, threads);
    }
    if (!(next.centre.norm() < now.centre.norm())) break;  // rounding, or nothing to centre
    parallel_for(map.points.rows(), grain, threads, [&](std::int64_t first, std::int64_t last) {
      for (Eigen::Index v = first; v < last; ++v) {
        map.points.row(v) = mobius_translated(map.points.row(v), a);
      }
    });
    now = next;
  }
  return map;
}

VectorX vertex_masses(const TriangleMesh& mesh) {
  const VectorX mass = vertex_areas(mesh);
  const double total = mass.sum();
  return total > 0 ? VectorX(mass / total)
                   : VectorX::Constant(mass.size(), 1.0 / double(mass.size()));
}

}  // namespace sphparam
