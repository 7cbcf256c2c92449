#pragma once

#include "embedding/newton/optimise.h"

namespace sphparam {

/// What a map is led to, and back from: equal areas, or kept angles.
enum class Kneading { ByAreas, ByAngles };

/// A map that has been led up to where areas are equal and angles hardly count, or the other way
/// round, and back: near a minimum of E, as a rule another one. Where limbs are long the energy has
/// many; what a limb's folds hold comes loose. Again and again it ends lower than other starts do.
/// `how`: energy, vertices that are pinned, threads, progress. Requires: EnergyKind::AngleAndArea.
/// Ensures: as `optimise`, but that E may rise. Cost: up to 66 steps of `optimise`, on most shapes
/// half of them. Source: our own.
SphereMap knead(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                Kneading kneading, const OptimiseOptions& how);

}  // namespace sphparam
