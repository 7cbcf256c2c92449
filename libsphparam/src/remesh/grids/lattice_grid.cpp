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

}  // namespace

SphereGrid cut_triangles(const Polyhedron& polyhedron, int n) {
  const EdgeNumbers edges(polyhedron, n);
  const int face_count = static_cast<int>(polyhedron.faces.size() / 3);
  const int within = (n - 1) * (n - 2) / 2;  // of one face
  SphereGrid grid;
  grid.directions.resize(edges.end() + face_count * within, 3);
  place_rims(polyhedron, edges, n, grid.directions);
  for (int f = 0; f < face_count; ++f) {
    const int* const corner = &polyhedron.faces[static_cast<size_t>(3 * f)];
    const int first = edges.end() + f * within;
    // Row i has i + 1 points, from the edge (0, 1) to the edge (0, 2).
    const auto at = [&](int i, int j) {
      if (j == 0) return edges.at(corner[0], corner[1], i);
      if (j == i) return edges.at(corner[0], corner[2], i);
      if (i == n) return edges.at(corner[1], corner[2], j);
      return first + (i - 1) * (i - 2) / 2 + j - 1;
    };
    const auto point = [&](int k) -> const Vector3& {
      return polyhedron.corners[static_cast<size_t>(corner[k])];
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j <= i; ++j) {
        if (j > 0 && j < i) {
          grid.directions.row(at(i, j)) = (n - i) * point(0) + (i - j) * point(1) + j * point(2);
        }
        add_face(grid.faces, {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        if (j < i) add_face(grid.faces, {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return grid;
}

SphereGrid cut_cube(int n) {
  const Polyhedron box = cube();
  const EdgeNumbers edges(box, n);
  const int within = (n - 1) * (n - 1);
  SphereGrid grid;
  grid.directions.resize(edges.end() + 6 * within, 3);
  place_rims(box, edges, n, grid.directions);
  for (int side = 0; side < 6; ++side) {
    const int* const corner = &box.faces[static_cast<size_t>(4 * side)];
    const int first = edges.end() + side * within;
    const auto at = [&](int i, int j) {
      if (j == 0) return edges.at(corner[0], corner[1], i);
      if (i == n) return edges.at(corner[1], corner[2], j);
      if (j == n) return edges.at(corner[3], corner[2], i);
      if (i == 0) return edges.at(corner[0], corner[3], j);
      return first + (j - 1) * (n - 1) + i - 1;
    };
    const auto point = [&](int k) -> const Vector3& {
      return box.corners[static_cast<size_t>(corner[k])];
    };
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        if (i > 0 && j > 0) {
          grid.directions.row(at(i, j)) =
              n * point(0) + i * (point(1) - point(0)) + j * (point(3) - point(0));
        }
        add_face(grid.faces, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return grid;
}

}  // namespace sphparam
