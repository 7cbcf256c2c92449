#pragma once

#include <optional>
#include <string>

#include "correspondence/coarse_to_fine.h"
#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// Whether landmarks fit the mirror image of `from`, with the same landmarks, about as well as
/// `from` or better: what is worth a word then. `direct`: the energy of `from` on its coarse level,
/// if it has one. Nothing is said of fewer than three landmarks, which have no sides, nor of those
/// that are released, where curvature decides.
/// Throws: MirroredLandmarks where they fit it far better. Cost: a hierarchy, and a start on it.
std::optional<std::string> suspicion_of_sides(const MappedMesh& from, const TargetSurface& target,
                                              const ComposedOptions& options,
                                              std::optional<double> direct);

}  // namespace sphparam
