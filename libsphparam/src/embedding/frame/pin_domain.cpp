#include "embedding/frame/pin_domain.h"

#include <set>

#include "option_domain.h"

namespace sphparam {

void require_pins(const std::vector<Pin>& pins, int vertex_count) {
  constexpr double unit = 1e-6;  // what squared lengths may be off
  std::set<Vertex> seen;
  for (const Pin& pin : pins) {
    require_vertex("pins: vertex", pin.vertex, vertex_count);
    if (!seen.insert(pin.vertex).second) {
      refuse_option("pins: vertex", pin.vertex, "of one pin only");
    }
    require_between("pins: squared length of the point", pin.point.squaredNorm(), 1 - unit,
                    1 + unit);
  }
}

}  // namespace sphparam
