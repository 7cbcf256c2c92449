#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Texture coordinates of the corners, and where an image goes on beyond a face with another place
/// of the surface.
struct SeamedTexcoords {
  CornerTexcoords corners;          // no rows: none
  std::vector<std::uint8_t> seams;  // a face: bit k where the edge that faces corner k is a seam

  std::uint8_t seams_of(Face f) const { return seams.empty() ? 0 : seams[static_cast<size_t>(f)]; }
};

/// An edge is a seam unless it has two faces, of one material, that agree on the coordinates of its
/// ends. `material`: of each face; null: all are of one. Cost: O(#F log #F).
SeamedTexcoords seamed(const Triangles& triangles, CornerTexcoords corners,
                       const Property* material);

}  // namespace sphparam
