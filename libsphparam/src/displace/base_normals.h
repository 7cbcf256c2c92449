#pragma once

#include <span>

#include "displace/normal_line.h"
#include "displace/place_finder.h"

namespace sphparam {

/// Lines along the normals of a base's surface, from there; where it has none, that is 0.
/// Requires: lines from `first` on as many as places.
void find_normals(std::span<const LimitPlace> places, PlaceFinder& patches, LineTable& lines,
                  size_t first = 0);

}  // namespace sphparam
