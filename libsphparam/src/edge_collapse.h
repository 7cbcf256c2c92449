#pragma once

#include <cmath>
#include <tuple>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The collapse of an edge onto one of its ends, as it waits in a queue for its turn.
struct EdgeCollapse {
  double cost;
  Vertex from, to;  // `from` goes
  int age;          // of both ends, added up: another one says that it is out of date

  bool operator<(const EdgeCollapse& other) const {  // the cheapest comes first
    return std::tie(other.cost, other.from, other.to) < std::tie(cost, from, to);
  }
};

/// Of a triangle: 1 where it is equilateral, 0 where it has no area.
inline double triangle_quality(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double lengths = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return lengths > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / lengths : 0;
}

}  // namespace sphparam
