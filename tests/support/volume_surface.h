#pragma once

#include <array>
#include <functional>

#include "sphparam/mesh/triangle_mesh.h"

/// Surfaces with many handles, as they come out of volumes.
namespace sphparam::tests {

/// Where a field on the grid 0 … size − 1 is above 0, with air around: a closed manifold, counter-
/// clockwise from outside, by marching tetrahedra. Any field will do.
TriangleMesh volume_surface(const std::array<int, 3>& size,
                            const std::function<double(int x, int y, int z)>& field);

/// Its part with the most faces.
TriangleMesh largest_part(const TriangleMesh& mesh);

/// A ball of that many voxels across with smoothed noise added: handles and tunnels by the dozen.
TriangleMesh noisy_ball(int across, double noise, unsigned seed);

/// Tubes along the lines of an nx × ny grid: (nx − 1)(ny − 1) handles. `step`: voxels between two.
TriangleMesh tube_grid(int nx, int ny, int step, double radius);

/// A torus with bumps, of genus 1: `around` × `along` quads, cut in two. `radius` of the tube, 1 of
/// its middle line.
TriangleMesh bumped_torus(int around, int along, double radius, double bumps, unsigned seed);

}  // namespace sphparam::tests
