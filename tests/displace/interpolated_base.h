#pragma once

#include "sphparam/remesh/limit_surface.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam::tests {

/// Control points whose limit surface goes through given points at the grid's vertices, to a
/// thousandth: each is moved by what its limit is off, again and again.
inline Points interpolating_control(const sphparam::SphereGrid& grid, const Points& targets,
                                    sphparam::Scheme scheme) {
  const auto topology =
      std::make_shared<const LimitTopology>(grid.faces, static_cast<int>(targets.rows()), scheme);
  std::vector<LimitPlace> places(static_cast<size_t>(targets.rows()), LimitPlace{-1, 0, 0});
  for (int f = 0; f < static_cast<int>(grid.faces.count()); ++f) {
    const auto polygon = grid.faces.polygon(f);
    for (size_t k = 0; k < polygon.size(); ++k) {
      const int first = topology->first_patch(f);
      LimitPlace place{first, k == 1 || (k == 2 && polygon.size() == 4) ? 1.0 : 0.0,
                       k >= 2 ? 1.0 : 0.0};
      if (topology->first_patch(f + 1) > first + 1) place = {first + static_cast<int>(k), 0, 0};
      places[static_cast<size_t>(polygon[k])] = place;
    }
  }
  Points control = targets;
  for (int round = 0; round < 10; ++round) {
    const auto limits = LimitSurface(topology, control).evaluate_all(places);
    for (Eigen::Index v = 0; v < control.rows(); ++v) {
      control.row(v) += targets.row(v) - limits[static_cast<size_t>(v)].position.transpose();
    }
  }
  return control;
}

}  // namespace sphparam::tests
