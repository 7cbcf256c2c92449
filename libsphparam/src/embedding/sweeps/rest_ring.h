#pragma once

#include <vector>

#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// The rest triangles around a vertex: one vertex at a time, where `RingPacks` are eight.
class RestRing {
 public:
  /// The edges from the vertex to its ring on the source. Triangles smaller than `area_floor` count
  /// as equilateral ones of that area.
  RestRing(const std::vector<Vector3>& edges, double area_floor);

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
