#pragma once

#include <array>
#include <stdexcept>
#include <string>

#include "sphparam/image/image.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/progress.h"
#include "sphparam/texture/equirectangular_image.h"

namespace sphparam {

/// Texture coordinates that no image can be painted for; the message says why.
class AtlasError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A warning for people where an image says that it was baked on another map of this mesh, and so
/// stands elsewhere on it; empty: it does not, or nobody knows. `name`: of the image. Cost: O(#V).
std::string warning_of_map(const std::string& name, const EquirectangularImage& image,
                           const MappedMesh& mapped);

struct PaintOptions {
  int threads = 0;         // 0: all cores
  Progress progress = {};  // "painting vertices"
};

/// The mesh with its map and, at its vertices, red, green and blue (and alpha, where the image has
/// it), whole numbers to 255: the mean of the image over each vertex's cell on the sphere, the
/// thirds of its triangles next to it, taken in linear light. Where texels are larger than the cell
/// that is the image at the vertex. Colours that were there are replaced, and textures left out,
/// which would be seen instead.
/// Ensures: same values for any number of threads. Throws: Cancelled. Cost: three lookups a
/// triangle.
MeshFile paint_vertices(const MappedMesh& mapped, const EquirectangularImage& image,
                        const PaintOptions& options = {});

struct AtlasOptions {
  int size = 2048;         // texels, each side of the square; 1 to 32768
  int padding = 16;        // texels, over the borders of the charts; 0 to 254
  int threads = 0;         // 0: all cores
  Progress progress = {};  // "painting the atlas"
};

struct PaintedAtlas {
  Image image;           // sRGB and alpha
  long painted = 0;      // texels whose centre a triangle holds
  long overlapping = 0;  // of them, those inside more than one; the first triangle has them
  std::array<Face, 2> rivals = {-1, -1};  // two triangles that overlap, or one and itself
};

/// Where triangles overlap, a warning for people, with two of them by their numbers in the file;
/// else empty.
std::string overlap_warning(const PaintedAtlas& atlas, const MeshFile& file);

/// An equirectangular image as a texture for the mesh's own coordinates: a texel whose centre lies
/// in a triangle, t upwards, gets the image where the geodesic map takes that point, the mean over
/// what the texel covers there. Coordinates outside [0, 1] repeat; colours run on over the borders
/// of charts.
///
/// Ensures: same values for any number of threads.
/// Throws: std::invalid_argument for options outside their domains; AtlasError for a mesh without
/// coordinates at its corners or vertices, for coordinates that are all of no area, and for
/// triangles across more than 8 repetitions; Cancelled. Cost: one lookup a texel, 21 bytes; and of
/// each triangle 9 ns a texel of its box, in all repetitions that this runs over, on one thread.
PaintedAtlas paint_atlas(const MappedMesh& mapped, const EquirectangularImage& image,
                         const AtlasOptions& options = {});

/// The bytes of a PNG of it, with alpha only if asked. Throws: ImageError.
std::string png_of(const PaintedAtlas& atlas, bool with_alpha);

}  // namespace sphparam
