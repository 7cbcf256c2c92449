#pragma once

#include <stdexcept>

#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// A vertex that has no direction from the centre.
class VertexAtCentre : public std::invalid_argument {
 public:
  explicit VertexAtCentre(Vertex vertex);
  Vertex vertex() const { return vertex_; }

 private:
  Vertex vertex_;
};

/// The direction of every vertex as seen from a centre, which is in the mesh's coordinates: unit
/// rays, whose θ and π/2 − ϕ are planetocentric longitude and latitude. As a map it is one-to-one
/// where the body is star-shaped about the centre: `certify`.
///
/// Ensures: right up to rounding for positions of any size. Throws: std::invalid_argument for a
/// centre or positions that are not finite; VertexAtCentre.
/// Cost: one pass.
SphereMap radial_directions(const TriangleMesh& mesh, const Vector3& centre = Vector3::Zero());

}  // namespace sphparam
