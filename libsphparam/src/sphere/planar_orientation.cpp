#include "sphere/planar_orientation.h"

#include "sphparam/sphere/orientation.h"

namespace sphparam {

int exact_planar_orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
  return exact_orientation({a.v, a.u, 1}, {b.v, b.u, 1}, {c.v, c.u, 1});
}

}  // namespace sphparam
