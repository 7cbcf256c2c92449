#pragma once

#include <memory>

#include "remesh/subdivision/patch_net.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/remesh/limit_surface.h"
#include "sphparam/remesh/sphere_grid.h"
#include "sphparam/sphere/sphere_locator.h"

namespace sphparam {

/// A limit surface over the sphere: at each place a point in space and a direction.
///
/// The direction of a place is that of the limit point which the grid's directions, as control
/// points, have there: as smooth as the surface itself, without kinks along the grid's edges. Our
/// own. Patches are faces: triangles among quads are first divided into quads, which leaves the
/// surface as it is.
class DirectedBase {
 public:
  /// Requires: a grid that is certified one-to-one, however quads are cut; a control point a
  /// vertex. Throws: std::invalid_argument, as LimitTopology does. Cost: some 4 µs a face.
  DirectedBase(const SphereGrid& grid, const Points& control, Scheme scheme, int threads = 0);
  DirectedBase(const DirectedBase&) = delete;
  DirectedBase& operator=(const DirectedBase&) = delete;

  const Polygons& faces() const { return faces_; }  // the patches
  const Polygons& grid_faces() const { return grid_faces_; }
  /// A place on a face of the grid (corner 0 at (0, 0), corner 1 at (1, 0), the last one at (0, 1))
  /// as one on the patches, where programs put it that subdivide what is straight over a face.
  /// Beyond the end of its face it is on the next one. And the way back.
  LimitPlace on_patches(const LimitPlace& on_face) const;
  LimitPlace on_face(const LimitPlace& on_patches) const;
  const LimitSurface& surface() const { return *surface_; }
  const LimitSurface& directions() const { return *directions_; }
  const PatchNet& net() const { return *net_; }

  /// Near the place with that direction: where it is on the flat faces of the grid.
  LimitPlace guess(const Vector3& direction) const;

 private:
  Polygons faces_;
  bool divided_ = false;
  std::unique_ptr<PatchNet> net_;
  std::unique_ptr<LimitSurface> surface_, directions_;
  Polygons grid_faces_;
  Triangulation cut_;  // of the grid
  SphereMap grid_map_;
  std::unique_ptr<Topology> grid_topology_;
  std::unique_ptr<SphereLocator> locator_;
};

}  // namespace sphparam
