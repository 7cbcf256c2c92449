#pragma once

#include <vector>

#include "embedding/energy/rest_floors.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// The rest triangles around a vertex: one vertex at a time, where `RingPacks` are eight.
class RestRing {
 public:
  /// The edges from the vertex to its ring on the source.
  RestRing(const std::vector<Vector3>& edges, const RestFloors& floors);

  /// Of the vertex at x; +∞ unless every triangle is certain to be positive.
  double energy(const DistortionEnergy& energy, const std::vector<Vector3>& ring,
                const Vector3& x) const;
  /// Is that much energy a sign of triangles squeezed into far too little room?
  bool is_narrow(const DistortionEnergy& energy, double value) const;
  /// Where the vertex lies in its ring on the source, carried to the sphere by mean value
  /// coordinates (see `place_in_rings`). It need not see the ring.
  Vector3 mean_value_point(const std::vector<Vector3>& ring) const;

 private:
  std::vector<RestTriangle> triangles_;
};

}  // namespace sphparam
