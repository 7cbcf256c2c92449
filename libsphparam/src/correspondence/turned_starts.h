#pragma once

#include <functional>
#include <vector>

#include "correspondence/coarse_to_fine.h"
#include "sphparam/sphere/spherical_correlation.h"

namespace sphparam {

/// Starts `way` at the map after each of these turns, and, where all of them lead to one map, half
/// a turn from it about each axis; leaves it at the one of least energy. Returns the confidence in
/// it: 0 where a start that leads elsewhere has as little energy beyond isometry's, towards 1 where
/// none comes near. Requires: at least one turn. `prepare` is called with each turn before `way`
/// starts there, also with the best one at last.
double start_at_best(
    CoarseToFine& way, const SphereMap& map, const std::vector<TurnOfFunctions>& turns,
    const ComposedEnergy& energy,
    const std::function<void(const Eigen::Matrix3d&)>& prepare = [](const Eigen::Matrix3d&) {});

/// Whether two maps of one mesh are different ones, not the same but for little.
bool leads_elsewhere(const SphereMap& one, const SphereMap& other);

/// In a start of so much energy beyond isometry's: 0 where that which leads elsewhere has as
/// little, towards 1 where it has far more.
double confidence_by_excess(double excess, double elsewhere);

}  // namespace sphparam
