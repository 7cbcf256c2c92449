#pragma once

#include <string>
#include <utility>
#include <vector>

#include "arguments/numbers.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam::cli {

/// What --energy of subcommands that match surfaces may be.
inline const std::vector<std::pair<std::string, EnergyKind>> energy_words = {
    {"symmetric-dirichlet", EnergyKind::SymmetricDirichlet},
    {"angle-area", EnergyKind::AngleAndArea}};

/// What --lambda may be.
inline const Range<double> lambdas = {least_lambda, greatest_lambda, "1e-10 to 1e6"};

}  // namespace sphparam::cli
