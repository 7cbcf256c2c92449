#pragma once

#include <array>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/mesh/surface_point.h"

namespace sphparam {

/// Two unit vectors that span the plane of a face, for ways, and how fast position and direction
/// change along them. All 0 in a face without area, which nothing leaves.
struct PlaceFrame {
  Vector3 u, v, of_u, of_v, turn_u, turn_v;
};

/// Where a vertex lies on the surface that is mapped to.
struct Place {
  SurfacePoint at;
  Vector3 position;   // in space, the surface scaled to the area 4π, its edges rounded
  Vector3 direction;  // on the sphere, of unit length up to rounding
  PlaceFrame frame;
};

/// A surface with its map, to move about on: steps are taken on the surface itself, so that they
/// are as long as they look however its map stretches it, and the direction follows.
class TargetSurface {
 public:
  /// Borrows the mesh and the topology; the locator of the mesh is made.
  explicit TargetSurface(const MappedMesh& mapped);
  /// The same where the mesh has other positions.
  TargetSurface(const MappedMesh& mapped, const Points& positions);

  /// Where the map has this direction; the place keeps its bits.
  Place place(const Vector3& direction) const;
  /// Where the straight line from a place ends that begins with this vector of its face's plane and
  /// is as long: over edges it goes on as if both faces lay in one plane. It ends early at what has
  /// no area. Cost: a face each 30 ns.
  Place walk(const Place& from, const Vector3& way) const;

  /// A corner of the face that a place is in.
  Vertex corner(const Place& place, int k) const { return topology_.vertex(place.at.face, k); }
  /// How fast the weights of these corners change along the two ways of the place's frame: what is
  /// linear in faces changes with them.
  Eigen::Matrix<double, 3, 2> changes_of_weights(const Place& place) const;

 private:
  using Corners = std::array<Vector3, 3>;

  Corners corners(Face face) const;
  Place place(const SurfacePoint& at) const;
  void measure(Place& place) const;

  const Topology& topology_;
  const SphereMap& map_;
  const SphereLocator& locator_;
  Points positions_, normals_;
};

/// The positions about their middle, scaled to the total area 4π.
/// Throws: UnmeasurableMesh where there is no area, or too much.
Points scaled_to_sphere(const TriangleMesh& mesh);

}  // namespace sphparam
