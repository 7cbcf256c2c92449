// Corner vᵢ of a triangle is nearest to face tᵢ of the other surface. For all x in the triangle
// d(x) ≤ min over i of dist(x, tᵢ) ≤ min over i of max over j of dist(vⱼ, tᵢ), as dist(·, t) is
// convex. Where all corners are nearest to one face this is their largest distance: nothing between
// them can be farther. A triangle is halved across its longest side.

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

constexpr size_t most_measurements = 1 << 14;
constexpr double worthwhile = 1.001;  // times the farthest so far
constexpr double loose = 2;  // a bound that many times the farthest is worth further measurements …
constexpr size_t most_a_face = 4;  // … but not more than so many a triangle

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

bool promises_less(const Piece& one, const Piece& other) { return one.bound < other.bound; }

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
  if (result.faces.size() <= most_measurements) return result;
  const auto bound = [&](Face f) { return bounds[static_cast<size_t>(f)]; };
  const auto last_of_most = result.faces.begin() + most_measurements;
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

}  // namespace

FarthestPoint find_farthest(const TriangleMesh& from, const VertexDistances& vertices,
                            const TriangleMesh& other, const RayScene& to,
                            const FarthestPoint& known, int threads) {
  FarthestPoint best = known;
  const Way way = {from, vertices, other};
  const Candidates candidates = promising_faces(way, known.distance, threads);
  std::vector<Piece> heap;
  for (const Face face : candidates.faces) heap.push_back(way.piece(face));
  std::make_heap(heap.begin(), heap.end(), promises_less);
  const size_t most = most_measurements + most_a_face * static_cast<size_t>(from.face_count());
  for (size_t measured = 0; measured < most && !heap.empty(); ++measured) {
    const double enough = measured < most_measurements ? worthwhile : loose;
    if (heap.front().bound <= enough * best.distance) break;
    std::pop_heap(heap.begin(), heap.end(), promises_less);
    const Piece piece = heap.back();
    heap.pop_back();
    const size_t apex = longest_side(piece), left = (apex + 1) % 3, right = (apex + 2) % 3;
    const Vector3 middle = (piece.corners[left].point + piece.corners[right].point) / 2;
    const NearestPoint found = to.nearest(middle, piece.corners[left].nearest);
    const Corner halfway = {middle, std::sqrt(found.squared_distance), found.on.face};
    if (halfway.distance > best.distance) {
      best.distance = halfway.distance;
      best.point = middle;
    }
    for (const size_t replaced : {left, right}) {
      Piece half = piece;
      half.corners[replaced] = halfway;
      half.bound = std::min(piece.bound, bound_of(half.corners, other));
      if (half.bound <= best.distance) continue;
      heap.push_back(half);
      std::push_heap(heap.begin(), heap.end(), promises_less);
    }
  }
  best.at_most =
      std::max({best.distance, candidates.bound_of_rest, heap.empty() ? 0.0 : heap.front().bound});
  return best;
}

}  // namespace sphparam
