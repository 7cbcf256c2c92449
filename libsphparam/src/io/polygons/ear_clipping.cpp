// An ear is a convex corner whose triangle holds no reflex corner. The sign of
//   turn(a, b, c) = (b − a) × (c − a)
// tells whether a triangle keeps the orientation of the polygon.

#include "io/polygons/ear_clipping.h"

#include <cmath>
#include <optional>
#include <utility>

namespace sphparam {
namespace {

double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Clips the ears of one polygon in its plane.
///
/// Clipping takes nothing out of a triangle but reflex corners that are reflex no more. So each
/// corner remembers how far down the list of reflex ones its triangle was found empty, and is asked
/// anew only when a neighbour is clipped.
class EarClipper {
 public:
  EarClipper(std::span<const int> polygon, std::vector<PlanePoint> plane, const EdgeSet& edges)
      : polygon_(polygon),
        plane_(std::move(plane)),
        edges_(edges),
        ring_(polygon.size()),
        is_reflex_(polygon.size()) {
    for (int i = 0; i < degree(); ++i)
      ring_[i] = {(i + degree() - 1) % degree(), (i + 1) % degree()};
    for (int i = 0; i < degree(); ++i) {
      is_reflex_[i] = !is_convex(i);
      if (is_reflex_[i]) reflex_.push_back(i);
    }
  }

  /// Appends corner triples. An ear along a used edge is taken only where there is no other, a
  /// corner that is no ear only where there is none (a polygon that crosses itself).
  void clip(std::vector<int>& triples) {
    int at = 0;
    for (int left = degree(); left > 3; --left) {
      at = choose(at, left);
      const int before = ring_[at].previous, after = ring_[at].next;
      triples.insert(triples.end(), {before, at, after});
      ring_[before].next = after;
      ring_[after].previous = before;
      is_reflex_[at] = false;
      for (const int i : {before, after}) {
        is_reflex_[i] = is_reflex_[i] && !is_convex(i);
        ring_[i].empty_of = 0;
      }
      at = ring_[after].next;  // not the neighbour: ears all around make better triangles
    }
    triples.insert(triples.end(), {ring_[at].previous, at, ring_[at].next});
  }

 private:
  struct Corner {
    int previous, next;
    std::size_t empty_of = 0;  // the first so many reflex corners are not in its triangle
  };

  int degree() const { return static_cast<int>(polygon_.size()); }

  bool is_convex(int i) const {
    return turn(plane_[ring_[i].previous], plane_[i], plane_[ring_[i].next]) > 0;
  }

  bool holds(int i, int reflex) const {
    const int before = ring_[i].previous, after = ring_[i].next;
    if (reflex == before || reflex == after) return false;
    const PlanePoint &a = plane_[before], &b = plane_[i], &c = plane_[after], &p = plane_[reflex];
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
  }

  bool is_ear(int i) {
    if (!is_convex(i)) return false;
    for (std::size_t& k = ring_[i].empty_of; k < reflex_.size(); ++k)
      if (is_reflex_[reflex_[k]] && holds(i, reflex_[k])) return false;
    return true;
  }

  bool cuts_along_used_edge(int i) const {
    return edges_.contains(polygon_[ring_[i].previous], polygon_[ring_[i].next]);
  }

  int choose(int start, int left) {
    std::optional<int> second_best;
    for (int i = start, tried = 0; tried < left; ++tried, i = ring_[i].next) {
      if (!is_ear(i)) continue;
      if (!cuts_along_used_edge(i)) return i;
      if (!second_best) second_best = i;
    }
    return second_best.value_or(start);
  }

  std::span<const int> polygon_;
  std::vector<PlanePoint> plane_;
  const EdgeSet& edges_;
  std::vector<Corner> ring_;
  std::vector<int> reflex_;  // those that were at the start
  std::vector<char> is_reflex_;
};

}  // namespace

void clip_ears(std::span<const int> polygon, std::vector<PlanePoint> plane, const EdgeSet& edges,
               std::vector<int>& triples) {
  EarClipper(polygon, std::move(plane), edges).clip(triples);
}

bool overlap(const std::vector<PlanePoint>& plane, std::span<const int> triples) {
  constexpr double rounding = 1e-9;
  double signed_area = 0, area = 0;
  for (std::size_t t = 0; t < triples.size(); t += 3) {
    const double twice = turn(plane[triples[t]], plane[triples[t + 1]], plane[triples[t + 2]]);
    signed_area += twice;
    area += std::abs(twice);
  }
  return area > (1 + rounding) * std::abs(signed_area);
}

}  // namespace sphparam
