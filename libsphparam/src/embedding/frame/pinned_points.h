#pragma once

#include <vector>

#include "embedding/frame/landmarks.h"

namespace sphparam {

/// Where a map has the vertices of pins, and where they are to be; a row a pin.
struct PinnedPoints {
  Points from, to;
};

inline PinnedPoints pinned_points(const SphereMap& map, const std::vector<Pin>& pins) {
  PinnedPoints points{Points(std::ssize(pins), 3), Points(std::ssize(pins), 3)};
  for (Eigen::Index i = 0; i < points.from.rows(); ++i) {
    const Pin& pin = pins[static_cast<size_t>(i)];
    points.from.row(i) = map.points.row(pin.vertex);
    points.to.row(i) = pin.point;
  }
  return points;
}

}  // namespace sphparam
