#pragma once

#include <string>

#include "sphparam/bake/bake.h"

namespace sphparam::cli {

/// What `sphparam bake --json` tells.
struct BakeTold {
  const std::string& input;
  long triangles;
  const std::string& target;  // empty: the source
  const BakeSettings& settings;
  const BakeReport& baked;
  double seconds;
};

std::string to_json(const BakeTold& told);

/// "statue.obj: ao, 2048 × 1024 uint8 → ao.png"
std::string line_of(const BakedImage& image, const BakeSettings& settings);

}  // namespace sphparam::cli
