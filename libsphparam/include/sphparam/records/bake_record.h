#pragma once

#include <string>

#include "sphparam/bake/bake.h"

namespace sphparam {

/// What was baked of what. References are to values that outlive the record.
struct BakeRecord {
  std::string input;  // the file of the source
  const MappedMesh& source;
  std::string target;  // the file of the mesh that the images are for; empty: the source's
  std::string from;    // the file of the surface that was baked on it; empty: itself
  const BakeSettings& settings;
  const BakeReport& baked;
  double seconds = 0;
};

/// As `sphparam bake --json` tells it.
std::string to_json(const BakeRecord& record);

/// "on the mesh along its normals; 1.2 % on the back of the surface, 0.3 % only at the nearest
/// point; half within 0.12 % of the diagonal, all within 2 %"
std::string line_of(const ProjectionShares& shares, const BakeSettings& settings);

/// "statue.obj: ao, 2048 × 1024 uint8 → ao.png"
std::string line_of(const BakedImage& image, const BakeSettings& settings);

}  // namespace sphparam
