#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/embedding/distortion_energy.h"

namespace sphparam::cli {

/// What --energy of subcommands that match surfaces may be.
inline const std::vector<std::pair<std::string, EnergyKind>> energy_words = {
    {"symmetric-dirichlet", EnergyKind::SymmetricDirichlet},
    {"angle-area", EnergyKind::AngleAndArea}};

}  // namespace sphparam::cli
