#pragma once

#include <random>

#include "sphparam/remesh/sphere_grid.h"
#include "sphparam/sphere/orientation.h"

namespace sphparam::tests {

inline bool is_one_to_one(const SphereGrid& grid) {
  for (std::int64_t f = 0; f < grid.faces.count(); ++f) {
    const auto p = grid.faces.polygon(f);
    if (orientation(grid.directions.row(p[0]), grid.directions.row(p[1]),
                    grid.directions.row(p[2])) <= 0)
      return false;
  }
  return true;
}

/// A grid whose vertices are drawn all but onto neighbours, where it stays one-to-one: its smooth
/// limit folds.
inline SphereGrid crumpled_grid() {
  SphereGrid grid = make_grid(parse_grid("octa:5"));
  std::mt19937 random(5);
  for (std::int64_t f = 0; f < 3 * grid.faces.count(); ++f) {
    const auto p = grid.faces.polygon(f % grid.faces.count());
    const int v = p[random() % 3], w = p[random() % 3];
    const Vector3 before = grid.directions.row(v), towards = grid.directions.row(w);
    grid.directions.row(v) = (0.01 * before + 0.99 * towards).normalized();
    if (v == w || !is_one_to_one(grid)) grid.directions.row(v) = before;
  }
  return grid;
}

}  // namespace sphparam::tests
