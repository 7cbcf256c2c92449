#include "sphparam/frame_check.h"

#include "embedding/frame/landmarks.h"

namespace sphparam {

FrameCheck check_frame(const Parameterization& result, const ParameterizeOptions& wanted) {
  FrameCheck check;
  const std::vector<double>& residuals = result.pin_residuals;
  check.pins =
      wanted.pins.empty() || (residuals.size() == wanted.pins.size() && all_exact(residuals));
  check.meridian = !wanted.meridian || result.meridian == wanted.meridian;
  if (!wanted.poles) return check;
  const auto [north, south] = *wanted.poles;
  check.poles = result.poles && result.poles->north == north && result.poles->south == south;
  if (result.map.points.rows() > 0) {
    check.pole_residuals =
        pin_residuals(result.map, {{north, Vector3::UnitZ()}, {south, -Vector3::UnitZ()}});
  }
  return check;
}

}  // namespace sphparam
