#pragma once

#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

/// The harmonics up to a degree: the surface without its detail. Residuals, and the values at the
/// vertices, are gone, as they are of all degrees. Requires: 0 ≤ degree ≤ that of the expansion.
/// Throws: std::invalid_argument if not.
HarmonicExpansion low_pass(HarmonicExpansion expansion, int degree);

/// The surface that harmonics describe, on a grid: each vertex is where they have its direction,
/// and the directions are its map. What was expanded besides x, y, z are properties of the
/// vertices. It needs no mesh: coefficients and functions of the expansion alone, and, where they
/// are known, `map` and `comments`. Its provenance says which grid and degree.
///
/// Requires: functions that begin with x, y, z, one a column. Ensures: the same bits for any number
/// of threads. Throws: std::invalid_argument if not, and as `synthesise`; UnmeasurableMesh for
/// positions beyond doubles; of a grid of one's own as `remesh`. Cost: `synthesise`'s, and the
/// certificate's.
MappedMesh harmonic_surface(const HarmonicExpansion& expansion, SphereGrid grid, int threads = 0);

}  // namespace sphparam
