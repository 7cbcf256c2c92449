#pragma once

#include <string>
#include <vector>

#include "bake/bake_scene.h"
#include "sphparam/image/image.h"
#include "sphparam/progress.h"

namespace sphparam {

/// An equirectangular image, and so a look that all models of a mesh can have.
struct PaintedSurface {
  std::string name;   // of the variant
  std::string label;  // on the page
  Image image;        // sRGB
};

/// The looks of one map: the mesh's own colours, where it has a texture or colours; fields of 15°
/// of the sphere; lettered axes; area and angle distortion on the scales of `heat_scale`; where it
/// has no colours, those of the directions in which the surface faces.
/// Requires: a certified chart. Ensures: the same names for every map of a mesh; same bytes for any
/// number of threads. Throws: Cancelled; FieldError for a texture without texture coordinates.
std::vector<PaintedSurface> painted_surfaces(const BakeScene& scene, int width,
                                             const Progress& progress = {});

}  // namespace sphparam
