#pragma once

#include <cstdint>
#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::campaign {

/// A mesh that is hard to map, and what is hard about it.
struct Specimen {
  std::string family;  // "tube 1000:1", "needles", …
  TriangleMesh mesh;
};

/// The specimen with a given number of a campaign. Ensures: the same for the same two numbers; a
/// closed genus-0 manifold with finite positions, mostly 8 to 2000 vertices, few up to 80,000.
Specimen make_specimen(std::uint64_t seed, std::uint64_t number);

}  // namespace sphparam::campaign
