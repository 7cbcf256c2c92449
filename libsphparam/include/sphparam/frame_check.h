#pragma once

#include <vector>

#include "sphparam/parameterize.h"

namespace sphparam {

/// Whether what was to be somewhere is there, exactly; true also for what was not asked for. A map
/// can be one-to-one and have its pins elsewhere: some places no map has.
struct FrameCheck {
  bool pins = true;      // each at its point
  bool poles = true;     // at +z and −z; of Method::Paper: those of its date line
  bool meridian = true;  // the vertex at θ = 0
  /// Radians of the poles asked for from +z and from −z; empty where none were, or there is no map.
  std::vector<double> pole_residuals = {};

  bool holds() const { return pins && poles && meridian; }
};

/// Holds a map against what was asked for. Requires: a result of these options, or one without a
/// map. Cost: little.
FrameCheck check_frame(const Parameterization& result, const ParameterizeOptions& wanted);

}  // namespace sphparam
