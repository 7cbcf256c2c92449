#pragma once

#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/sphere/spherical_correlation.h"

namespace sphparam {

/// How vertices' values are compared on the sphere.
struct MapSignalOptions {
  int degree = 16;  // 1 to greatest_harmonic_degree: of the harmonics that are left of them
  int threads = 0;
};

/// What a map of a surface looks like, whatever way it is turned: two functions on the sphere as
/// harmonics, the mean curvature, bounded, and how much area a place of the sphere stands for: ln
/// of the area ratio, cut at e³. Cost: that of curvature and of `fit_harmonics`. Throws:
/// UnmeasurableMesh; SolveError.
Functions map_signals(const MappedMesh& mapped, const MapSignalOptions& options = {});

/// The same of values at the vertices, a column a function: #V×k.
/// Throws: std::invalid_argument where there is not a row a vertex.
Functions map_signals(const MappedMesh& mapped, const Functions& values,
                      const MapSignalOptions& options = {});

/// How one map may be turned so that it lies as another: the best first.
/// Requires and throws: as `turns_by_correlation`. Cost: about 50 ms.
std::vector<TurnOfFunctions> align_maps(const MappedMesh& from, const MappedMesh& to, int most = 4,
                                        const MapSignalOptions& options = {});

/// The map turned, and proved again. Throws: NotCertifiedError where rounding folds it.
MappedMesh turned_map(const MappedMesh& mapped, const Eigen::Matrix3d& rotation);

}  // namespace sphparam
