// Grids without levels. A lattice point of a polyhedron lies in a corner, in an edge or in a face;
// those of an edge are numbered from its lower corner, so that both faces agree.

#include "remesh/grids/lattice_grid.h"

#include <algorithm>
#include <map>
#include <utility>

#include "remesh/grids/grid_parts.h"

namespace sphparam {

namespace {

/// Numbers for the lattice points within the edges of a polyhedron: N − 1 an edge.
class EdgeNumbers {
 public:
  EdgeNumbers(const Polyhedron& polyhedron, int n) : n_(n) {
    next_ = static_cast<int>(polyhedron.corners.size());
    const auto degree = static_cast<size_t>(polyhedron.degree);
    for (size_t f = 0; f < polyhedron.faces.size(); f += degree) {
      for (size_t k = 0; k < degree; ++k) {
        const int a = polyhedron.faces[f + k], b = polyhedron.faces[f + (k + 1) % degree];
        if (first_.emplace(std::minmax(a, b), next_).second) next_ += n - 1;
      }
    }
  }
  /// The point `step` steps from a to b, 0 ≤ step ≤ N.
  int at(int a, int b, int step) const {
    if (step == 0) return a;
    if (step == n_) return b;
    return first_.at(std::minmax(a, b)) + (a < b ? step : n_ - step) - 1;
  }
  int end() const { return next_; }
  const std::map<std::pair<int, int>, int>& first() const { return first_; }

 private:
  int n_, next_;
  std::map<std::pair<int, int>, int> first_;
};

/// Corners times N, and the points within the edges.
void place_rims(const Polyhedron& polyhedron, const EdgeNumbers& edges, int n, Points& points) {
  for (size_t v = 0; v < polyhedron.corners.size(); ++v) {
    points.row(static_cast<Eigen::Index>(v)) = n * polyhedron.corners[v];
  }
  for (const auto& [ends, first] : edges.first()) {
    const Vector3 &a = polyhedron.corners[static_cast<size_t>(ends.first)],
                  &b = polyhedron.corners[static_cast<size_t>(ends.second)];
    for (int step = 1; step < n; ++step) points.row(first + step - 1) = (n - step) * a + step * b;
  }
}

/// The corners of a polyhedron's face, and the number of the first point within it, where each has
/// `within` of them.
struct LatticeFace {
  LatticeFace(const Polyhedron& polyhedron, const EdgeNumbers& edges, int n, int face, int within)
      : polyhedron_(polyhedron),
        edges_(edges),
        corner_(&polyhedron.faces[static_cast<size_t>(polyhedron.degree * face)]),
        n_(n),
        first_(edges.end() + face * within) {}

  /// The point `step` steps from corner a to corner b.
  int on_edge(int a, int b, int step) const { return edges_.at(corner_[a], corner_[b], step); }
  const Vector3& corner(int k) const {
    return polyhedron_.corners[static_cast<size_t>(corner_[k])];
  }

 protected:
  const Polyhedron& polyhedron_;
  const EdgeNumbers& edges_;
  const int* corner_;
  int n_, first_;
};

/// Row i has i + 1 points, from the edge (0, 1) to the edge (0, 2).
struct LatticeTriangle : LatticeFace {
  using LatticeFace::LatticeFace;
  static int within(int n) { return (n - 1) * (n - 2) / 2; }

  int at(int i, int j) const {
    if (j == 0) return on_edge(0, 1, i);
    if (j == i) return on_edge(0, 2, i);
    if (i == n_) return on_edge(1, 2, j);
    return first_ + (i - 1) * (i - 2) / 2 + j - 1;
  }
  Vector3 point(int i, int j) const {
    return (n_ - i) * corner(0) + (i - j) * corner(1) + j * corner(2);
  }
};

/// i runs along the edge (0, 1), j along the edge (0, 3).
struct LatticeSquare : LatticeFace {
  using LatticeFace::LatticeFace;
  static int within(int n) { return (n - 1) * (n - 1); }

  int at(int i, int j) const {
    if (j == 0) return on_edge(0, 1, i);
    if (i == n_) return on_edge(1, 2, j);
    if (j == n_) return on_edge(3, 2, i);
    if (i == 0) return on_edge(0, 3, j);
    return first_ + (j - 1) * (n_ - 1) + i - 1;
  }
  Vector3 point(int i, int j) const {
    return n_ * corner(0) + i * (corner(1) - corner(0)) + j * (corner(3) - corner(0));
  }
};

void add(const LatticeTriangle& side, int n, SphereGrid& grid) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (j > 0 && j < i) grid.directions.row(side.at(i, j)) = side.point(i, j);
      add_face(grid.faces, {side.at(i, j), side.at(i + 1, j), side.at(i + 1, j + 1)});
      if (j < i) add_face(grid.faces, {side.at(i, j), side.at(i + 1, j + 1), side.at(i, j + 1)});
    }
  }
}

void add(const LatticeSquare& side, int n, SphereGrid& grid) {
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      if (i > 0 && j > 0) grid.directions.row(side.at(i, j)) = side.point(i, j);
      add_face(grid.faces,
               {side.at(i, j), side.at(i + 1, j), side.at(i + 1, j + 1), side.at(i, j + 1)});
    }
  }
}

template <class Side>
SphereGrid cut(const Polyhedron& polyhedron, int n) {
  const EdgeNumbers edges(polyhedron, n);
  const int sides = static_cast<int>(polyhedron.faces.size()) / polyhedron.degree;
  SphereGrid grid;
  grid.directions.resize(edges.end() + sides * Side::within(n), 3);
  place_rims(polyhedron, edges, n, grid.directions);
  for (int f = 0; f < sides; ++f) add(Side(polyhedron, edges, n, f, Side::within(n)), n, grid);
  return grid;
}

}  // namespace

SphereGrid cut_triangles(const Polyhedron& polyhedron, int n) {
  return cut<LatticeTriangle>(polyhedron, n);
}

SphereGrid cut_cube(int n) { return cut<LatticeSquare>(cube(), n); }

}  // namespace sphparam
