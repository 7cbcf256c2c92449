#pragma once

#include <array>
#include <stdexcept>

#include "sphparam/measure/surface_distance.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/progress.h"

namespace sphparam {

/// How near the surface is drawn about what it encloses, and how finely.
struct WrapOptions {
  /// Between points of the lattice, in units of the mesh. 0: as `resolution` says.
  double voxel = 0;
  /// Voxels along the longest side of the soup's box, where `voxel` is 0. 0: 128 of them, or so
  /// many that two fit into `distance`.
  int resolution = 0;
  /// Of the surface from the soup; a voxel at least. 0: two voxels.
  double distance = 0;
  /// What is left of the distance when the surface is drawn in at last. It may then cut into the
  /// soup, by less than a voxel, and itself, which `find_self_crossings` counts. 0: all of it.
  double gap = 0;
  /// Of shells that are apart the one with the largest volume is kept; else all are joined.
  bool largest = false;
  /// About so many triangles are left of the surface, never fewer than 4; the least visible
  /// vertices go first. It is then only about as far from the soup, and may cut into it and itself.
  /// 0: all.
  long faces = 0;
  int threads = 0;  // 0: all cores
  Progress progress = {};
};

/// A voxel that is too small for a lattice about the soup. The message names what it follows from,
/// `resolution` where that is given, `distance` where that is small, else `voxel`, and about what
/// would do.
class VoxelError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A closed surface about a soup of triangles.
struct Wrap {
  TriangleMesh mesh;                       // closed, manifold, of genus 0, outward
  double voxel = 0, distance = 0;          // as used
  std::array<int, 3> lattice = {0, 0, 0};  // points each way
  long lattice_faces = 0;                  // triangles, before it got fewer

  long parts = 0;     // shells that were apart at this distance
  double gap = 0;     // as used; `distance` where the surface is not drawn in
  long insides = 0;   // of closed parts, as their faces look
  long cavities = 0;  // beside these, that nothing reaches from outside: solid now
  bool skin = false;  // next to nothing of them, the soup is open: see `closing_distance`
  long handles = 0;   // what went through them is closed by walls, a voxel thick
  /// Of the volume, what was added to be rid of handles and to join parts.
  double added_share = 0;
  /// Of the volume of all parts, that of the one that was kept. 1 where they were joined.
  double kept_share = 1;

  long soup_vertices = 0;  // that triangles use
  long outside = 0;        // of these; none unless `largest` dropped their parts, or options say so
  SurfaceDistance apart;   // forth: of the wrap from the soup; back: of the soup from the wrap
  double volume = 0, area = 0, soup_area = 0;  // of the mesh, of the soup
};

/// Encloses any triangles (open, not manifold, in many parts, passing through one another) in one
/// closed surface of genus 0, which lies at `distance` from them.
///
/// Method: the exact distance from the soup at the points of a lattice; of what is nearer than
/// `distance`, the part that the outside surrounds. Cubes of the lattice are cut into six
/// tetrahedra each (Freudenthal), in which the distance is linear: its level set is a surface
/// without self-intersections, whatever the soup is like. It is off from `distance` by less than a
/// voxel, as no point of a tetrahedron is farther than √3/2 voxels from its corners in the mean,
/// and so encloses all of the soup. Where that surface has handles, or parts that are apart, the
/// solid is instead carved out of the full box, the farthest points first, each only where neither
/// solid nor air changes its topology (simple points; Bertrand, "Simple points, topological numbers
/// and geodesic neighborhoods in cubic grids", 1994): walls a voxel thick stay across holes,
/// bridges between parts. With `gap`, vertices at the distance then go in along their normals until
/// only that is left, where the soup lets them; walls and bridges stay. Our own: on the lattice of
/// tetrahedra, whose links are spheres, a point is simple when both sides of its link are
/// connected. A volume library's level set was tried: its distances are off by 0.76 voxels eight
/// voxels from the soup, and it knows no topology.
///
/// Requires: a lattice of at most 100 million points.
/// Throws: MeshError where triangles name vertices that are not there or not finite, or there are
///         none; UnmeasurableMesh where they all are one point, or coordinates are too large for
///         the voxel; VoxelError; std::invalid_argument, which names the option; Cancelled.
/// Ensures: `require_sphere` takes the mesh; the same bytes for any number of threads.
/// Cost: 5 bytes a point of the lattice, 9 where it is carved; about 2 µs a point near the surface.
Wrap wrap_soup(const TriangleMesh& soup, const WrapOptions& options = {});

/// The distance, more than this one, from which on a wrap encloses more than a skin about open
/// sheets, as it closes what is open between them: about, by the sight of a coarse lattice. 0: none
/// that is a quarter of the soup's extent or less does. Requires: a soup that has a wrap.
/// Ensures: the same bits for any number of threads. Cost: about a second.
double closing_distance(const TriangleMesh& soup, double distance, int threads = 0);

}  // namespace sphparam
