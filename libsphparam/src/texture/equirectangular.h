#pragma once

#include <array>

#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/texture/convention.h"
#include "texture/texture_pyramid.h"

namespace sphparam {

/// Looks an equirectangular image up by direction: periodic in longitude, and over a pole it goes
/// on on the other side, half a turn away.
///
/// A lookup has a size, the width of what it stands for on the sphere. Where texels are larger it
/// is bilinear; where they are smaller it is the mean of as many as that width holds: by the levels
/// of the pyramid in latitude, and by several samples in longitude, as towards the poles more and
/// more texels of a row lie within one width. Our own.
class EquirectangularImage {
 public:
  /// The pyramid outlives it.
  EquirectangularImage(const TexturePyramid& pyramid, Convention convention)
      : pyramid_(&pyramid), convention_(info_of(convention)) {}

  /// Linear red, green, blue and alpha in the direction, of any length but 0; `width` in radians.
  /// Cost: 50 ns, 1/sin ϕ times that where texels are smaller than the width.
  std::array<float, 4> look_up(const Vector3& direction, double width) const;

 private:
  const TexturePyramid* pyramid_;
  ConventionInfo convention_;
};

}  // namespace sphparam
