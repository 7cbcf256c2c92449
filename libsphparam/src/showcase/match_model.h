#pragma once

#include <string>
#include <vector>

#include "report/viewer.h"
#include "sphparam/correspondence/surface_map.h"
#include "sphparam/gltf/export.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam {

/// A morph for a page, and what can be seen on it.
struct MatchModel {
  std::string glb;
  std::vector<ViewedSurface> surfaces;  // the first is seen first
  std::vector<std::string> warnings;
};

/// `make_morph`, B scaled to A's area, with the looks of both; a checker of the sphere that they
/// share; the places on the second, in the colours of `place_colours`; area and angle distortion
/// between the two. Of `options`: as `make_morph`. `distortion`: of the map.
/// Throws: as `make_morph`. Cost: that of baking the images.
MatchModel match_model(const SurfaceMap& map, const Distortion& distortion, ExportOptions options);

}  // namespace sphparam
