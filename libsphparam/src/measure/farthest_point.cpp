// Corner vᵢ of a triangle is nearest to face tᵢ of the other surface. For all x in the triangle
// d(x) ≤ min over i of dist(x, tᵢ) ≤ min over i of max over j of dist(vⱼ, tᵢ), as dist(·, t) is
// convex. Where all corners are nearest to one face this is their largest distance: nothing between
// them can be farther.
//
// Where two corners are nearest to faces s and t, the side between them is cut where it is as far
// from s as from t: the parts then lie along one face each, however long the side is. Where each
// side lies along some face and the piece does not, a vertex that their faces have in common is
// beneath it, and the piece is cut at that vertex's foot. Else the longest side is halved.

#include "measure/farthest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rays/triangle_distance.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr size_t most_cuts = 1 << 14;
constexpr double worthwhile = 1.001;  // times the farthest so far
constexpr double loose = 2;        // a bound that many times the farthest is worth further cuts …
constexpr size_t most_a_face = 4;  // … so many a triangle, or as many as wanted if that is more
constexpr int most_halvings = 30;  // on the way to where two faces are equally far

struct Corner {
  Vector3 point;
  double distance;
  Face nearest;  // of the other surface
};

struct Piece {
  std::array<Corner, 3> corners;
  double bound;
};

double distance_to(const TriangleMesh& mesh, Face face, const Vector3& point) {
  const auto corners = mesh.triangles.row(face);
  return std::sqrt(nearest_on_triangle(point, mesh.position(corners[0]), mesh.position(corners[1]),
                                       mesh.position(corners[2]))
                       .squared_distance);
}

double bound_of(const std::array<Corner, 3>& corners, const TriangleMesh& other) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    double largest = 0;
    for (size_t j = 0; j < 3; ++j) {
      const bool same = corners[i].nearest == corners[j].nearest;
      largest = std::max(largest, same ? corners[j].distance
                                       : distance_to(other, corners[i].nearest, corners[j].point));
    }
    least = std::min(least, largest);
  }
  return least;
}

/// The pieces that are left, the one of the greatest bound first.
class Pieces {
 public:
  bool empty() const { return heap_.empty(); }
  double greatest_bound() const { return empty() ? 0 : heap_.front().bound; }

  void add(const Piece& piece) {
    if (free_.empty()) {
      free_.push_back(pieces_.size());
      pieces_.emplace_back();
    }
    heap_.push_back({piece.bound, free_.back()});
    pieces_[free_.back()] = piece;
    free_.pop_back();
    std::push_heap(heap_.begin(), heap_.end(), promises_less);
  }

  Piece take_first() {
    std::pop_heap(heap_.begin(), heap_.end(), promises_less);
    free_.push_back(heap_.back().place);
    heap_.pop_back();
    return pieces_[free_.back()];
  }

 private:
  struct Promise {
    double bound;
    size_t place;
  };
  static bool promises_less(const Promise& one, const Promise& other) {
    return one.bound < other.bound;
  }

  std::vector<Promise> heap_;
  std::vector<Piece> pieces_;
  std::vector<size_t> free_;
};

/// A surface on the way to another.
struct Way {
  const TriangleMesh& from;
  const VertexDistances& vertices;
  const TriangleMesh& other;

  Piece piece(Face face) const {
    Piece result;
    for (int i = 0; i < 3; ++i) {
      const Vertex v = from.triangles(face, i);
      result.corners[static_cast<size_t>(i)] = {from.position(v), vertices.distances[v],
                                                vertices.nearest[static_cast<size_t>(v)]};
    }
    result.bound = bound_of(result.corners, other);
    return result;
  }
};

/// The most promising triangles, as many as can be looked into, and the bound of all others.
struct Candidates {
  std::vector<Face> faces;
  double bound_of_rest = 0;
};

Candidates promising_faces(const Way& way, double known, int threads) {
  std::vector<double> bounds(static_cast<size_t>(way.from.face_count()));
  parallel_for(way.from.face_count(), 4096, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t f = first; f < last; ++f) {
      bounds[static_cast<size_t>(f)] = way.piece(static_cast<Face>(f)).bound;
    }
  });
  Candidates result;
  for (size_t f = 0; f < bounds.size(); ++f) {
    if (bounds[f] > known) result.faces.push_back(static_cast<Face>(f));
  }
  if (result.faces.size() <= most_cuts) return result;
  const auto bound = [&](Face f) { return bounds[static_cast<size_t>(f)]; };
  const auto last_of_most = result.faces.begin() + most_cuts;
  std::nth_element(result.faces.begin(), last_of_most, result.faces.end(), [&](Face a, Face b) {
    return bound(a) != bound(b) ? bound(a) > bound(b) : a < b;
  });
  const auto first_left = std::stable_partition(last_of_most, result.faces.end(),
                                                [&](Face f) { return bound(f) > loose * known; });
  for (auto f = first_left; f != result.faces.end(); ++f) {
    result.bound_of_rest = std::max(result.bound_of_rest, bound(*f));
  }
  result.faces.erase(first_left, result.faces.end());
  return result;
}

size_t longest_side(const Piece& piece) {
  size_t longest = 0;
  double length = -1;
  for (size_t i = 0; i < 3; ++i) {
    const double side =
        (piece.corners[(i + 1) % 3].point - piece.corners[(i + 2) % 3].point).squaredNorm();
    if (side <= length) continue;
    length = side;
    longest = i;
  }
  return longest;
}

double bound_of_side(const Corner& a, const Corner& b, const TriangleMesh& other) {
  if (a.nearest == b.nearest) return std::max(a.distance, b.distance);
  return std::min(std::max(a.distance, distance_to(other, a.nearest, b.point)),
                  std::max(b.distance, distance_to(other, b.nearest, a.point)));
}

/// The point of a side that is as far from the one end's face as from the other's; or one that is
/// near enough to both.
Vector3 between_faces(const Corner& a, const Corner& b, const TriangleMesh& other,
                      double near_enough) {
  double low = 0, high = 1;
  Vector3 point;
  for (int i = 0; i < most_halvings; ++i) {
    const double middle = (low + high) / 2;
    point = a.point + middle * (b.point - a.point);
    const double to_a = distance_to(other, a.nearest, point),
                 to_b = distance_to(other, b.nearest, point);
    if (std::max(to_a, to_b) <= near_enough) break;
    (to_a < to_b ? low : high) = middle;
  }
  return point;
}

/// Of the faces that the corners are nearest to; −1: none.
Vertex common_vertex(const Piece& piece, const Triangles& triangles) {
  const auto is_of = [&](Vertex v, const Corner& corner) {
    return (triangles.row(corner.nearest).array() == v).any();
  };
  for (int k = 0; k < 3; ++k) {
    const Vertex v = triangles(piece.corners[0].nearest, k);
    if (is_of(v, piece.corners[1]) && is_of(v, piece.corners[2])) return v;
  }
  return -1;
}

/// Where a piece is cut: at a point of the side opposite to a corner, or within.
struct Cut {
  Vector3 point;
  size_t opposite;
};
constexpr size_t within = 3;

Cut best_cut(const Piece& piece, const TriangleMesh& other, double known) {
  const auto corner = [&](size_t i) -> const Corner& { return piece.corners[i % 3]; };
  const auto bound = [&](size_t i) { return bound_of_side(corner(i + 1), corner(i + 2), other); };
  const std::array bounds = {bound(0), bound(1), bound(2)};
  const auto worst =
      static_cast<size_t>(std::max_element(bounds.begin(), bounds.end()) - bounds.begin());
  if (bounds[worst] > known)
    return {between_faces(corner(worst + 1), corner(worst + 2), other, known), worst};
  if (const Vertex v = common_vertex(piece, other.triangles); v >= 0) {
    const Vector3 weights =
        nearest_on_triangle(other.position(v), corner(0).point, corner(1).point, corner(2).point)
            .barycentric;
    if (weights.minCoeff() > 0) {
      return {weights[0] * corner(0).point + weights[1] * corner(1).point +
                  weights[2] * corner(2).point,
              within};
    }
  }
  const size_t longest = longest_side(piece);
  return {(corner(longest + 1).point + corner(longest + 2).point) / 2, longest};
}

/// A face of those that the piece knows, where that is no farther than what is known; else the
/// nearest.
Corner corner_at(const Vector3& point, const Piece& piece, const TriangleMesh& other,
                 const RayScene& to, double known) {
  Corner best = {point, std::numeric_limits<double>::infinity(), -1};
  for (const Corner& corner : piece.corners) {
    const double distance = distance_to(other, corner.nearest, point);
    if (distance < best.distance) best = {point, distance, corner.nearest};
  }
  if (best.distance <= known) return best;
  const NearestPoint found = to.nearest(point, best.nearest);
  return {point, std::sqrt(found.squared_distance), found.on.face};
}

}  // namespace

FarthestPoint find_farthest(const TriangleMesh& from, const VertexDistances& vertices,
                            const TriangleMesh& other, const RayScene& to,
                            const FarthestPoint& known, std::int64_t wanted_cuts, int threads) {
  FarthestPoint best = known;
  const Way way = {from, vertices, other};
  const Candidates candidates = promising_faces(way, known.distance, threads);
  Pieces pieces;
  for (const Face face : candidates.faces) pieces.add(way.piece(face));
  const size_t most = most_cuts + std::max(most_a_face * static_cast<size_t>(from.face_count()),
                                           static_cast<size_t>(wanted_cuts));
  for (size_t cuts = 0; cuts < most && !pieces.empty(); ++cuts) {
    const double enough = cuts < most_cuts ? worthwhile : loose;
    if (pieces.greatest_bound() <= enough * best.distance) break;
    const Piece piece = pieces.take_first();
    const Cut cut = best_cut(piece, other, best.distance);
    const Corner corner = corner_at(cut.point, piece, other, to, best.distance);
    if (corner.distance > best.distance) {
      best.distance = corner.distance;
      best.point = cut.point;
    }
    for (size_t replaced = 0; replaced < 3; ++replaced) {
      if (replaced == cut.opposite) continue;
      Piece part = piece;
      part.corners[replaced] = corner;
      part.bound = std::min(piece.bound, bound_of(part.corners, other));
      if (part.bound > best.distance) pieces.add(part);
    }
  }
  best.at_most = std::max({best.distance, candidates.bound_of_rest, pieces.greatest_bound()});
  return best;
}

}  // namespace sphparam
