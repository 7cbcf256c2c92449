#pragma once

#include "remesh/sphere_grid.h"

namespace sphparam {

/// The 12·NSIDE² pixel centres of HEALPix in RING order, and the mesh they span: a face for each
/// point where pixels meet, four of them but at eight points, where three do.
/// Source: Górski et al., "HEALPix: a framework for high-resolution discretization and fast
/// analysis of data distributed on the sphere" (2005), Section 5.
SphereGrid healpix_grid(int nside);

}  // namespace sphparam
