// An ear is a convex corner whose triangle holds no reflex corner. The sign of
//   turn(a, b, c) = (b − a) × (c − a)
// tells whether a triangle keeps the orientation of the polygon.

#include "io/polygons/ear_clipping.h"

#include <optional>
#include <utility>

namespace sphparam {
namespace {

double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Clips the ears of one polygon in its plane.
class EarClipper {
 public:
  EarClipper(std::span<const int> polygon, std::vector<PlanePoint> plane, const EdgeSet& edges)
      : polygon_(polygon), plane_(std::move(plane)), edges_(edges), ring_(polygon.size()) {
    for (int i = 0; i < degree(); ++i)
      ring_[i] = {(i + degree() - 1) % degree(), (i + 1) % degree()};
    for (int i = 0; i < degree(); ++i)
      if (!is_convex(i)) reflex_.push_back(i);
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
      std::erase_if(
          reflex_, [&](int i) { return i == at || ((i == before || i == after) && is_convex(i)); });
      at = ring_[after].next;  // not the neighbour: ears all around make better triangles
    }
    triples.insert(triples.end(), {ring_[at].previous, at, ring_[at].next});
  }

 private:
  struct Neighbours {
    int previous, next;
  };

  int degree() const { return static_cast<int>(polygon_.size()); }

  bool is_convex(int i) const {
    return turn(plane_[ring_[i].previous], plane_[i], plane_[ring_[i].next]) > 0;
  }

  bool is_ear(int i) {
    budget_ -= static_cast<long>(reflex_.size());
    const int before = ring_[i].previous, after = ring_[i].next;
    const PlanePoint &a = plane_[before], &b = plane_[i], &c = plane_[after];
    if (turn(a, b, c) <= 0) return false;
    return std::none_of(reflex_.begin(), reflex_.end(), [&](int r) {
      const PlanePoint& p = plane_[r];
      return r != before && r != after && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
             turn(c, a, p) >= 0;
    });
  }

  bool cuts_along_used_edge(int i) const {
    return edges_.contains(polygon_[ring_[i].previous], polygon_[ring_[i].next]);
  }

  int choose(int start, int left) {
    std::optional<int> second_best;
    for (int i = start, tried = 0; tried < left && budget_ > 0; ++tried, i = ring_[i].next) {
      if (!is_ear(i)) continue;
      if (!cuts_along_used_edge(i)) return i;
      if (!second_best) second_best = i;
    }
    return second_best.value_or(start);
  }

  std::span<const int> polygon_;
  std::vector<PlanePoint> plane_;
  const EdgeSet& edges_;
  std::vector<Neighbours> ring_;
  std::vector<int> reflex_;
  // Corners looked at: a polygon made to have no ear anywhere would cost degree³. When it is spent,
  // corners are clipped as they come.
  long budget_ = 4L * degree() * degree();
};

}  // namespace

void clip_ears(std::span<const int> polygon, std::vector<PlanePoint> plane, const EdgeSet& edges,
               std::vector<int>& triples) {
  EarClipper(polygon, std::move(plane), edges).clip(triples);
}

}  // namespace sphparam
