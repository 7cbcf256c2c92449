#include "rays/nearest_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "rays/triangle_distance.h"

// A tree has boxes in floats; every triangle that it comes to is judged here, in doubles. A box may
// be passed over only if no triangle in it can be the nearest, so the radius of the search is the
// distance known so far, widened by what rounding may have cost.
//
// For a point p far away floats cannot tell distances apart; the search then goes round a point p'
// on the way from p to the centre, at distance D' ≥ r from it, where all of the mesh is within r =
// √3. Lemma: where x is no farther from p than y, |p' − x|² ≤ |p' − y|² + r². Proof: with centre 0
// and p = D u, |p − x| ≤ |p − y| says g_D(x) ≤ g_D(y) for g_D(x) = |x|²/2D − u·x. As D' ≤ D,
// g_D'(x) ≤ g_D(x) + r²/2D' ≤ g_D(y) + r²/2D' ≤ g_D'(y) + r²/2D'; times 2D', plus D'².
//
// Most triangles are farther away than the best so far already by their boxes. That is told from
// squared distances, whose rounding must not decide: a point of a triangle is computed to within
// 8√3 roundings of the longest vector that goes in, and the distance of a box likewise, e = 2⁻⁴⁷ L
// together, so that one found at distance d has a box at d + e at most, and
// (d + e)² ≤ (1 + 2⁻³⁰) d² + (1 + 2³⁰) e².

namespace sphparam {
namespace {

// Beyond the rounding of the mesh and of the point (2⁻²⁴ of the size of each, times √3) and of the
// tree's few operations (some 2⁻²⁴ of the radius each).
constexpr double position_slack = 0x1p-21, radius_slack = 0x1p-20;

constexpr double squared_reach_of_cube = 3;  // r²
constexpr double far_away = 1024;            // D': the widening r² is a thousandth of the radius

/// L²: from the point to any other of the mesh, and of two sides of a triangle.
double squared_longest(const SceneFrame& frame, const Vector3& point) {
  const double longest = (point - frame.centre).stableNorm() + 2.5 * frame.diagonal;
  return longest * longest;
}

}  // namespace

NearestSearch::NearestSearch(const TriangleMesh& mesh, const std::vector<Face>& faces,
                             const SceneFrame& frame, const Vector3& point, double near_enough)
    : mesh_(mesh),
      faces_(faces),
      frame_(frame),
      point_(point),
      near_enough_(near_enough),
      slack_(0x1p-63 * squared_longest(frame, point)),
      centre_(frame.local(point)) {
  if (centre_.squaredNorm() <= far_away * far_away) return;
  const Vector3 away = (point - frame.centre).stableNormalized();
  centre_ = far_away * (frame.turn ? Vector3(*frame.turn * away) : away);
  widening_ = squared_reach_of_cube;
}

void NearestSearch::pass_over_what_is_not_near_enough() {
  beyond_ = std::min(beyond_, widened_square(near_enough_));
}

bool NearestSearch::come_to(unsigned number) {
  ++visited_;
  return !ends() && consider(faces_[number]);
}

bool NearestSearch::consider(Face face) {
  const auto corners = mesh_.triangles.row(face);
  const Vector3 a = mesh_.position(corners[0]), b = mesh_.position(corners[1]),
                c = mesh_.position(corners[2]);
  if (is_beyond_best(a, b, c)) return false;
  const TrianglePoint found = nearest_on_triangle(point_, a, b, c);
  const double squared = found.squared_distance;
  const bool first = best_.on.face < 0;
  const bool wins =
      first || squared < best_.squared_distance ||
      (squared == best_.squared_distance && face < best_.on.face);  // whoever came first
  if (!wins) return false;
  best_ = {{face, found.barycentric}, squared};
  beyond_ = std::min(beyond_, widened_square(squared));
  const Vector3& w = found.barycentric;
  foot_ = w[0] * frame_.local(a) + w[1] * frame_.local(b) + w[2] * frame_.local(c);
  return true;
}

float NearestSearch::radius() const {
  if (best_.on.face < 0) return std::numeric_limits<float>::infinity();
  return widened(std::sqrt((centre_ - foot_).squaredNorm() + widening_));
}

float NearestSearch::radius_of_near_enough() const {
  if (widening_ > 0) return std::numeric_limits<float>::infinity();
  return widened(std::sqrt(near_enough_) * frame_.scale);
}

bool NearestSearch::is_beyond_best(const Vector3& a, const Vector3& b, const Vector3& c) const {
  const Vector3 lower = a.cwiseMin(b).cwiseMin(c), upper = a.cwiseMax(b).cwiseMax(c);
  return (lower - point_).cwiseMax(point_ - upper).cwiseMax(0).squaredNorm() > beyond_;
}

double NearestSearch::widened_square(double squared) const {
  return (1 + 0x1p-30) * squared + slack_;
}

float NearestSearch::widened(double known) const {
  const double size = 1 + centre_.cwiseAbs().maxCoeff();
  return static_cast<float>(known * (1 + radius_slack) + position_slack * size);
}

}  // namespace sphparam
