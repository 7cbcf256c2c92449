#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// What is told of a mesh whose coordinates are all numbers of 32 bits and lie so far from the
/// origin that these are more than a tenth of its mean edge apart: its area, volume and distances
/// are not those of the thing. Empty of others. `read_mesh` makes a note of it.
/// Cost: O(#V + #F), next to nothing where a coordinate has more digits.
std::string coarse_coordinates(const TriangleMesh& mesh);

/// Those of the notes that are such.
std::vector<std::string> coarse_coordinates_among(const std::vector<std::string>& notes);

}  // namespace sphparam
