#pragma once

#include "option_domain.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Throws: std::invalid_argument where the energy is not in the domain that its header states.
inline void require_domain(const DistortionEnergy& energy) {
  require_one_of("energy.kind", energy.kind, EnergyKind::SymmetricDirichlet);
  require_between("energy.lambda", energy.lambda, 0, greatest_lambda);
  require_at_least("energy.epsilon", energy.epsilon, 0);
  require_finite("energy.pressure", energy.pressure);
}

}  // namespace sphparam
