// For a point x of a triangle with corners vᵢ at distances dᵢ: d(x) ≤ min (dᵢ + |x − vᵢ|), and
// |x − vᵢ| is at most the longer side at vᵢ. A triangle is halved across its longest side.

#include "measure/farthest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sphparam::tools {

namespace {

constexpr size_t most_measurements = 1 << 14;
constexpr double worthwhile = 1.001;  // times the farthest so far

struct Corner {
  Vector3 point;
  double distance;
  Face nearest = -1;  // of the other surface, where it is known
};

struct Piece {
  std::array<Corner, 3> corners;
  double bound;
};

double bound_of(const std::array<Corner, 3>& corners) {
  std::array<double, 3> side;  // opposite corner i
  for (size_t i = 0; i < 3; ++i) {
    side[i] = (corners[(i + 1) % 3].point - corners[(i + 2) % 3].point).norm();
  }
  double bound = corners[0].distance + std::max(side[1], side[2]);
  for (size_t i = 1; i < 3; ++i) {
    bound = std::min(bound, corners[i].distance + std::max(side[(i + 1) % 3], side[(i + 2) % 3]));
  }
  return bound;
}

bool promises_less(const Piece& one, const Piece& other) { return one.bound < other.bound; }

Piece piece_of(const TriangleMesh& mesh, const Eigen::VectorXd& at_vertices, Face face) {
  Piece piece;
  for (int i = 0; i < 3; ++i) {
    const Vertex v = mesh.triangles(face, i);
    piece.corners[static_cast<size_t>(i)] = {.point = mesh.position(v), .distance = at_vertices[v]};
  }
  piece.bound = bound_of(piece.corners);
  return piece;
}

/// A triangle and what it promises.
struct Candidate {
  double bound;
  Face face;
};

/// The most promising triangles, as many as can be looked into, and the bound of all others.
struct Candidates {
  std::vector<Candidate> chosen;
  double bound_of_rest = 0;
};

Candidates promising_faces(const TriangleMesh& mesh, const Eigen::VectorXd& at_vertices,
                           double known) {
  Candidates result;
  std::vector<Candidate>& all = result.chosen;
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    const double bound = piece_of(mesh, at_vertices, f).bound;
    if (bound > known) all.push_back({bound, f});
  }
  if (all.size() <= most_measurements) return result;
  const auto first_left = all.begin() + most_measurements;
  std::nth_element(all.begin(), first_left, all.end(), [](const Candidate& a, const Candidate& b) {
    return a.bound != b.bound ? a.bound > b.bound : a.face < b.face;
  });
  result.bound_of_rest = first_left->bound;
  all.erase(first_left, all.end());
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

FarthestPoint find_farthest(const TriangleMesh& from, const Eigen::VectorXd& at_vertices,
                            const RayScene& to, const FarthestPoint& known) {
  FarthestPoint best = known;
  const Candidates candidates = promising_faces(from, at_vertices, known.distance);
  std::vector<Piece> heap;
  for (const Candidate& candidate : candidates.chosen) {
    heap.push_back(piece_of(from, at_vertices, candidate.face));
  }
  std::make_heap(heap.begin(), heap.end(), promises_less);
  for (size_t measured = 0; measured < most_measurements && !heap.empty(); ++measured) {
    if (heap.front().bound <= worthwhile * best.distance) break;
    std::pop_heap(heap.begin(), heap.end(), promises_less);
    const Piece piece = heap.back();
    heap.pop_back();
    const size_t apex = longest_side(piece), left = (apex + 1) % 3, right = (apex + 2) % 3;
    const Vector3 middle = (piece.corners[left].point + piece.corners[right].point) / 2;
    const Face guess = std::max(piece.corners[left].nearest, piece.corners[right].nearest);
    const NearestPoint found = to.nearest(middle, guess);
    const Corner halfway = {middle, std::sqrt(found.squared_distance), found.on.face};
    if (halfway.distance > best.distance) {
      best.distance = halfway.distance;
      best.point = middle;
    }
    for (const size_t replaced : {left, right}) {
      Piece half = piece;
      half.corners[replaced] = halfway;
      half.bound = std::min(piece.bound, bound_of(half.corners));
      if (half.bound <= best.distance) continue;
      heap.push_back(half);
      std::push_heap(heap.begin(), heap.end(), promises_less);
    }
  }
  best.at_most =
      std::max({best.distance, candidates.bound_of_rest, heap.empty() ? 0.0 : heap.front().bound});
  return best;
}

}  // namespace sphparam::tools
