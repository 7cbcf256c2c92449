#pragma once

#include <string>
#include <vector>

#include "bake/image_plan.h"

namespace sphparam {

/// What looks wrong with a mesh as a body's: a map that is radial about another centre than the
/// body's, another unit than the body's.
std::vector<std::string> doubts_about_body(const MappedMesh& source, const Body& body,
                                           const Vector3& centre);

/// Adds the sidecars of images of a body, and says in the report where they are, what they call
/// longitude and latitude, and what looks wrong: a map that is radial about another centre than the
/// body's, a mesh in another unit than the body, images that geographic programs do not read,
/// sidecars of an earlier image where none is written.
void add_sidecars(const std::vector<PlannedImage>& images, const MappedMesh& source,
                  const BakeScene& scene, const BakeSettings& settings, PendingFiles& files,
                  BakeReport& report);

}  // namespace sphparam
