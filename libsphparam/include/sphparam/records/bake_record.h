#pragma once

#include <string>

#include "sphparam/bake/bake.h"

namespace sphparam {

/// What was baked of what. References are to values that outlive the record.
struct BakeRecord {
  std::string input;  // the file of the source
  const MappedMesh& source;
  std::string target;  // the file of the mesh that the images are for; empty: the source's
  const BakeSettings& settings;
  const BakeReport& baked;
  double seconds = 0;
};

/// As `sphparam bake --json` tells it.
std::string to_json(const BakeRecord& record);

/// "statue.obj: ao, 2048 × 1024 uint8 → ao.png"
std::string line_of(const BakedImage& image, const BakeSettings& settings);

}  // namespace sphparam
