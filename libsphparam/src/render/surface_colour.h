#pragma once

#include "render/render.h"

namespace sphparam {

/// A point of a triangle that is seen.
struct ShadedSample {
  Face face = 0;
  Eigen::Vector3d weights;        // barycentric coordinates here …
  Eigen::Vector3d weights_right;  // … one pixel to the right, of the triangle's plane …
  Eigen::Vector3d weights_below;  // … and one pixel down
  Eigen::Vector3d edge_distance;  // pixels to the side that faces corner k
  Eigen::Vector3d altitude;       // pixels from that side to corner k
  bool front = true;
};

/// Colours the points of one object: paint, overlays, light.
class SurfaceColour {
 public:
  /// view: rows are the camera's right, up and towards-the-eye directions. pixels: the longer side
  /// of the picture.
  SurfaceColour(const RenderObject& object, const Eigen::Matrix3d& view, int pixels, int threads);

  /// Linear RGB.
  Rgb operator()(const ShadedSample& sample) const;

 private:
  Rgb painted(const ShadedSample& sample) const;
  Rgb with_graticule(const ShadedSample& sample, const Rgb& below) const;
  Rgb with_wireframe(const ShadedSample& sample, const Rgb& below) const;
  Rgb lit(const ShadedSample& sample, const Rgb& colour) const;
  Vector3 normal_at(const ShadedSample& sample) const;

  const RenderObject* object_;
  Eigen::Matrix3d view_;
  Points normals_;         // #V×3, in camera directions
  Eigen::VectorXf light_;  // #V, visible share of the sky; empty: all of it
};

}  // namespace sphparam
