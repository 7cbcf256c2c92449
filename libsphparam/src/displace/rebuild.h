#pragma once

#include <cstdint>
#include <functional>

#include "displace/directed_base.h"
#include "remesh/texture_lattice.h"
#include "sphparam/image/image.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// A mesh of a displaced base.
struct Rebuilt {
  TriangleMesh mesh, base;  // displaced; the limit surface itself, at the same vertices
  Polygons faces;           // of which the triangles are made
  SphereMap map;            // the vertices' directions, unit
};

/// Vertices that show what an image holds of a mesh: one for four texels, at least two for one of
/// the mesh's. With fewer the flat triangles between them are what is measured.
std::int64_t vertices_to_rebuild(const Image& displacement, std::int64_t mesh_vertices);

/// Cuts of a patch's edges so that the rebuilt mesh has `vertices` vertices or more; at least 2.
int cuts_for(const DirectedBase& base, std::int64_t vertices);

/// How far to move a point of the base, by its place and its direction.
using HeightAt = std::function<double(const LimitPlace& place, const Vector3& direction)>;

/// Cuts every patch into `cuts`² pieces and moves their corners along the limit normal by what the
/// image has in their direction: bilinear between the middles of texels, periodic in longitude,
/// and on beyond a pole half a turn away.
/// Requires: one channel, as `make_displacement` makes it. Throws: std::invalid_argument for more
/// faces than can be numbered. Ensures: the same bytes for any number of threads.
Rebuilt rebuild(const DirectedBase& base, const Image& displacement, int cuts, int threads = 0);

Rebuilt rebuild(const DirectedBase& base, const HeightAt& heights, int cuts, int threads = 0);

/// What the image has in a direction of any length but 0.
double displacement_in(const Image& image, const Vector3& direction);

/// What an image in the layout of a grid has at a point of it: bilinear between the middles of
/// texels, as programs look it up.
double displacement_at(const Image& image, const TextureLattice& lattice, const TexelPoint& point);

}  // namespace sphparam
