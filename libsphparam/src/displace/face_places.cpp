// What is straight over a face, as programs subdivide it: of a quad, bilinear over its quarters; of
// a triangle by Catmull's and Clark's scheme, bilinear over the three quads that its first step
// makes of it, each with a corner C, the middles of the edges to the next corner N and the one
// before P, and the middle of the face. At (a, b) of it N has the weight a(½ − b/6), P has b(½ −
// a/6). The difference of the two is (a − b)/2, which leaves b² − (3 − δ)b + 6p = 0 for δ = a − b.

#include <algorithm>
#include <cmath>

#include "displace/directed_base.h"

namespace sphparam {

namespace {

constexpr int most_crossings = 8;        // of sides, by a place beyond its face
constexpr double edge_rounding = 1e-12;  // beyond the end of a face, and still in it

/// Within a quarter of a quad, as the corner k has it.
LimitPlace in_quarter(int k, double s, double t) {
  const double along[4] = {s, t, 1 - s, 1 - t}, across[4] = {t, 1 - s, 1 - t, s};
  return {k, 2 * along[k], 2 * across[k]};
}

/// The inverse.
LimitPlace out_of_quarter(int k, double a, double b) {
  const double s[4] = {a / 2, 1 - b / 2, 1 - a / 2, b / 2},
               t[4] = {b / 2, a / 2, 1 - b / 2, 1 - a / 2};
  return {0, s[k], t[k]};
}

/// Within the quad that a triangle has at its corner k, by the weights of its corners.
LimitPlace in_third(const Vector3& weights) {
  int k = 0;
  weights.maxCoeff(&k);
  const double next = weights[(k + 1) % 3], previous = weights[(k + 2) % 3],
               difference = 2 * (next - previous), half = (3 - difference) / 2;
  const double b = half - std::sqrt(std::max(0.0, half * half - 6 * previous));
  return {k, std::clamp(b + difference, 0.0, 1.0), std::clamp(b, 0.0, 1.0)};
}

/// The inverse.
LimitPlace out_of_third(int k, double a, double b) {
  Vector3 weights;
  weights[(k + 1) % 3] = a * (0.5 - b / 6);
  weights[(k + 2) % 3] = b * (0.5 - a / 6);
  weights[k] = 1 - weights[(k + 1) % 3] - weights[(k + 2) % 3];
  return {0, weights[1], weights[2]};
}

LimitPlace crossed(const PatchNet& net, LimitPlace place) {
  for (int i = 0; i < most_crossings && net.beyond(place) > edge_rounding; ++i)
    place = net.cross(place);
  return clamped(place, net.degree());
}

}  // namespace

LimitPlace DirectedBase::on_patches(const LimitPlace& on_face) const {
  if (!divided_) return crossed(*net_, on_face);
  const int first = grid_faces_.starts[static_cast<size_t>(on_face.patch)];
  const double s = std::clamp(on_face.s, 0.0, 1.0), t = std::clamp(on_face.t, 0.0, 1.0);
  const int quarter = s < 0.5 ? (t < 0.5 ? 0 : 3) : (t < 0.5 ? 1 : 2);
  LimitPlace place = grid_faces_.degree(on_face.patch) == 4 ? in_quarter(quarter, s, t)
                                                            : in_third({1 - s - t, s, t});
  place.patch += first;
  return place;
}

LimitPlace DirectedBase::on_face(const LimitPlace& on_patches) const {
  if (!divided_) return on_patches;
  const auto& starts = grid_faces_.starts;
  const auto after = std::upper_bound(starts.begin(), starts.end(), on_patches.patch);
  const auto face = static_cast<int>(after - starts.begin()) - 1;
  const int k = on_patches.patch - starts[static_cast<size_t>(face)];
  LimitPlace place = grid_faces_.degree(face) == 4 ? out_of_quarter(k, on_patches.s, on_patches.t)
                                                   : out_of_third(k, on_patches.s, on_patches.t);
  place.patch = face;
  return place;
}

}  // namespace sphparam
