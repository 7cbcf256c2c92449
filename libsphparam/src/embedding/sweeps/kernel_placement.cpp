#include "embedding/sweeps/kernel_placement.h"

#include <algorithm>

#include "sphparam/sphere/orientation.h"

// The kernel is the cone n_i · x > 0 of the edge normals n_i = p_i × p_{i+1}. Its deepest point
// maximises the least n_i · x over unit x: the centre of the smallest cap that holds all unit
// normals. That is the smallest enclosing ball problem, solved incrementally (Welzl 1991): whenever
// a normal lies outside the cap of its predecessors, it lies on the border of the new cap.
// The answer is only a candidate; the exact predicate has the last word.

namespace sphparam {
namespace {

struct Cap {
  Vector3 centre;
  double cosine;  // of its radius: n · centre ≥ cosine inside

  bool holds(const Vector3& n) const { return n.dot(centre) >= cosine - 1e-15; }
};

Cap cap_of(const Vector3& a, const Vector3& b) {
  // In a sliver the normals are nearly opposite and their sum is little but rounding. Its part
  // across their difference is what matters: a centre that is equally far from both.
  const Vector3 sum = a + b, difference = a - b;
  const Vector3 across =
      sum - difference * (difference.dot(sum) / std::max(difference.squaredNorm(), 1e-300));
  const double length = across.norm();
  // Opposite normals: the kernel is a single great circle's arc; any direction across serves.
  const Vector3 centre = length > 0 ? Vector3(across / length) : a.unitOrthogonal();
  return {centre, length / 2};
}

Cap cap_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  // The product of the shortest difference with another: in a sliver the two others are parallel.
  const Vector3 ab = b - a, bc = c - b, ca = a - c;
  const double ab2 = ab.squaredNorm(), bc2 = bc.squaredNorm(), ca2 = ca.squaredNorm();
  const Vector3 normal = ab2 <= bc2 && ab2 <= ca2 ? ab.cross(bc)
                         : bc2 <= ca2             ? bc.cross(ca)
                                                  : ca.cross(ab);
  const double length = normal.norm();
  if (!(length > 0)) return cap_of(a, b);
  Vector3 centre = normal / length;
  if (centre.dot(a + b + c) < 0) centre = -centre;
  return {centre, centre.dot(a)};
}

Cap smallest_cap(const std::vector<Vector3>& normals) {
  Cap cap{normals[0], 1};
  for (size_t i = 1; i < normals.size(); ++i) {
    if (cap.holds(normals[i])) continue;
    cap = cap_of(normals[0], normals[i]);
    for (size_t j = 1; j < i; ++j) {
      if (cap.holds(normals[j])) continue;
      cap = cap_of(normals[j], normals[i]);
      for (size_t k = 0; k < j; ++k) {
        if (!cap.holds(normals[k])) cap = cap_of(normals[k], normals[j], normals[i]);
      }
    }
  }
  return cap;
}

bool sees_all_edges(const std::vector<Vector3>& ring, const Vector3& x) {
  for (size_t i = 0; i < ring.size(); ++i) {
    if (orientation(x, ring[i], ring[(i + 1) % ring.size()]) <= 0) return false;
  }
  return true;
}

}  // namespace

std::optional<Vector3> place_in_kernel(const std::vector<Vector3>& ring) {
  std::vector<Vector3> normals;
  Vector3 sum = Vector3::Zero();
  for (size_t i = 0; i < ring.size(); ++i) {
    // Differences first: the ring is small, and p × q = p × (q − p).
    normals.push_back(ring[i].cross(ring[(i + 1) % ring.size()] - ring[i]).normalized());
    sum += ring[i];
  }
  const Cap cap = smallest_cap(normals);
  const Vector3 mean = sum.normalized();
  double depth = 1;
  for (const Vector3& n : normals) depth = std::min(depth, n.dot(mean));
  // The mean when it is at least half as deep as can be: it distorts less than the deepest point.
  if (depth > 0.5 * cap.cosine && sees_all_edges(ring, mean)) return mean;
  if (sees_all_edges(ring, cap.centre)) return cap.centre;
  if (sees_all_edges(ring, mean)) return mean;
  return std::nullopt;
}

}  // namespace sphparam
