#pragma once

#include "displace/directed_base.h"
#include "remesh/texture_lattice.h"
#include "sphparam/image/image.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/remesh/displacement.h"
#include "sphparam/sphere/sphere_locator.h"

namespace sphparam {

/// How far a surface is from a base, in every direction.
///
/// The image is equirectangular: column c and row r are the direction θ = 2π(c + ½)/width,
/// ϕ = π(r + ½)/height. It holds the signed distance, in units of the mesh, from the base's point
/// with that direction (see `DirectedBase`) along the unit normal of its limit surface, outwards,
/// to the surface: base + displacement · normal.
struct Displacement {
  Image image;  // one channel
  DisplacementFigures figures = {};
};

/// The displacement from a base to a mapped mesh.
/// Requires: the locator of a map of unit rays, certified one-to-one; width and height from 1, at
/// most `most_texels`.
/// Throws: Cancelled. Ensures: the same bytes for any number of threads. Cost: some 0.07 µs a
/// texel.
Displacement make_displacement(const DirectedBase& base, const TriangleMesh& mesh,
                               const Topology& topology, const SphereLocator& locator,
                               const DisplacementOptions& options = {});

/// The same in the layout of the base's own grid: each texel has the place of the base that it
/// shows, and the mesh's point in the direction of that.
Displacement make_displacement(const DirectedBase& base, const TextureLattice& lattice,
                               const TriangleMesh& mesh, const Topology& topology,
                               const SphereLocator& locator,
                               const DisplacementOptions& options = {});

}  // namespace sphparam
