// The icosahedron's sides come in fours: two that make a diamond with a corner at the north pole,
// two that make one with a corner at the south pole. A diamond is a square whose one diagonal is
// the edge between its two sides.

#include <array>

#include "remesh/grids/grid_chart.h"
#include "remesh/grids/polyhedron.h"

namespace sphparam {

namespace {

using Square = std::array<std::array<double, 2>, 3>;

/// Where the corners of the two sides of a diamond are on its square.
constexpr Square first_half = {{{0, 0}, {0, 1}, {1, 0}}}, second_half = {{{0, 1}, {1, 1}, {1, 0}}};

/// How many times each corner of a triangle a lattice point of it is, times n.
Vector3 lattice_weights(const Eigen::Matrix3d& from_space, const Vector3& point, int n) {
  const Vector3 weights = from_space * point;
  return (weights * (n / weights.sum())).array().round();
}

/// From points to weights of the corners of a side.
Eigen::Matrix3d weights_of_side(const Polyhedron& solid, std::int64_t side) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k)
    corners.col(k) =
        solid.corners[static_cast<size_t>(solid.faces[static_cast<size_t>(3 * side + k)])];
  return corners.inverse();
}

ChartCorner on_square(int tile, const Square& square, const Vector3& weights) {
  ChartCorner corner{tile, 0, 0};
  for (int k = 0; k < 3; ++k) {
    corner.x += weights[k] * square[static_cast<size_t>(k)][0];
    corner.y += weights[k] * square[static_cast<size_t>(k)][1];
  }
  return corner;
}

}  // namespace

std::vector<ChartCorner> corners_on_diamonds(int n, const Points& flat, const Polygons& faces) {
  const Polyhedron solid = icosahedron();
  const std::int64_t sides = std::ssize(solid.faces) / 3, of_side = faces.count() / sides;
  std::vector<ChartCorner> corners;
  corners.reserve(faces.corners.size());
  for (std::int64_t side = 0; side < sides; ++side) {
    const Eigen::Matrix3d from_space = weights_of_side(solid, side);
    const int quarter = static_cast<int>(side / 4), diamond = static_cast<int>(side / 2) % 2;
    for (std::int64_t f = side * of_side; f < (side + 1) * of_side; ++f) {
      for (const int v : faces.polygon(f))
        corners.push_back(on_square(diamond * 5 + quarter, side % 2 == 0 ? first_half : second_half,
                                    lattice_weights(from_space, flat.row(v), n)));
    }
  }
  return corners;
}

}  // namespace sphparam
