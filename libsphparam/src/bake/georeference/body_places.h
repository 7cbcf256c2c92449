#pragma once

#include <optional>
#include <string>

#include "bake/bake_scene.h"
#include "sphparam/bake/bake.h"

namespace sphparam {

/// How the texels of images of a radial map lie on the body.
struct BodyPlaces {
  double off = 0;  // what a texel shows may be so far from its direction, in radians; 0: exact
  std::string how = {};  // what it is that is off, for names: "sphparam radial map"
};

/// Nothing where the map is not radial about the body's centre, or not what its header says of
/// that. What is linear in (u, v), or found
/// along normals, is measured at the texels, 2048 a row at most.
/// Requires: the scene of `source`, its options with the body's centre.
std::optional<BodyPlaces> body_places(const MappedMesh& source, const BakeScene& scene,
                                      const BakeSettings& settings);

}  // namespace sphparam
