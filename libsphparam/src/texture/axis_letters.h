#pragma once

#include "sphparam/image/image.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A point of the sphere's picture of the six axes.
struct AxisPoint {
  Eigen::Vector3f colour;  // sRGB
  double margin;           // no other colour is nearer than this, radians
};

/// The colour in a direction of any length but 0. Each of the six sides of a cube about the sphere
/// has its axis' colour (x red, y green, z blue; negative ones darker), a light rim, and the name
/// of the axis in strokes.
AxisPoint axis_picture(const Vector3& direction);

}  // namespace sphparam
