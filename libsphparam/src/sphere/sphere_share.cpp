#include "sphparam/sphere/sphere_share.h"

#include <cmath>
#include <numbers>

#include "sphere/solid_angle.h"

namespace sphparam {

double sphere_share(const Triangles& triangles, const SphereMap& map, const FillerMarks& marked) {
  double area = 0;
  for (Eigen::Index f = 0; f < std::ssize(marked); ++f) {
    if (!marked[f]) continue;
    area += std::abs(solid_angle(map.point(triangles(f, 0)), map.point(triangles(f, 1)),
                                 map.point(triangles(f, 2))));
  }
  return area / (4 * std::numbers::pi);
}

}  // namespace sphparam
