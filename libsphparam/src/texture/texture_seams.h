#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Texture coordinates of the corners, and where an image goes on beyond a face with another place
/// of the surface.
struct SeamedTexcoords {
  CornerTexcoords corners;  // no rows: none
  // A face: bit k where the edge that faces corner k is a seam, bit 3 + k where it is one unless
  // the image repeats.
  std::vector<std::uint8_t> seams;

  std::uint8_t seams_of(Face f) const { return seams.empty() ? 0 : seams[static_cast<size_t>(f)]; }
};

/// An edge is a seam unless it has two faces, of one material, that agree on the coordinates of its
/// ends; where these are whole images apart, as on the back of a ball, an image that repeats goes
/// on. `material`: of each face; null: all are of one. Cost: O(#F log #F).
SeamedTexcoords seamed(const Triangles& triangles, CornerTexcoords corners,
                       const Property* material);

}  // namespace sphparam
