#pragma once

#include <array>
#include <stdexcept>

#include "sphparam/image/image.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"
#include "texture/equirectangular.h"

namespace sphparam {

/// Texture coordinates that no image can be painted for; the message says why.
class AtlasError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct AtlasOptions {
  int size = 2048;   // texels, each side of the square
  int padding = 16;  // texels, over the borders of the charts; at most 254
  int threads = 0;
  Progress progress = {};
};

struct PaintedAtlas {
  Image image;           // sRGB and alpha
  long painted = 0;      // texels whose centre a triangle holds
  long overlapping = 0;  // of them, those inside more than one; the first triangle has them
  std::array<Face, 2> rivals = {-1, -1};  // two triangles that overlap
};

/// An equirectangular image as a texture for the mesh's own coordinates: a texel whose centre lies
/// in a triangle, t upwards, gets the image where the geodesic map takes that point, the mean over
/// what the texel covers there. Coordinates outside [0, 1] repeat.
///
/// Requires: unit rays, a map that `certify` calls bijective; size ≥ 1.
/// Throws: AtlasError for a mesh without coordinates at its corners or vertices, for coordinates
/// that are all of no area, and for triangles across more than 8 repetitions; Cancelled. Same
/// values for any number of threads. Cost: one lookup a texel, 21 bytes.
PaintedAtlas paint_atlas(const MeshFile& file, const SphereMap& map,
                         const EquirectangularImage& image, const AtlasOptions& options);

}  // namespace sphparam
