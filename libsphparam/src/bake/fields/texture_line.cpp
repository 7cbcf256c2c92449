// Texture coordinates are linear on a face, so that along a run they take equal steps, and what a
// texel covers of the texture is the same for all of the run.

#include "bake/fields/texture_line.h"

namespace sphparam {

TextureLine texture_line(const SurfaceRun& run, const SeamedTexcoords& texcoords,
                         const TexturePlacement& placement) {
  TextureLine line{{0, 1}, {0, 0}, {0, 0}, run.count};
  const CornerTexcoords& corners = texcoords.corners;
  if (corners.rows() == 0) return line;
  line.face.seams = texcoords.seams_of(run.face);
  line.first[0] = placement[0][2];
  line.first[1] = 1 - placement[1][2];
  for (int k = 0; k < 3; ++k) {
    const double s = corners(3 * run.face + k, 0), t = corners(3 * run.face + k, 1);
    const double x = placement[0][0] * s + placement[0][1] * t,
                 y = -(placement[1][0] * s + placement[1][1] * t);
    const double xy[2] = {x, y};
    for (int c = 0; c < 2; ++c) {
      line.first[c] += run.first[k] * xy[c];
      line.step[c] += run.step[k] * xy[c];
      line.below[c] += run.below[k] * xy[c];
      line.face.corners[k][c] = xy[c];
    }
    line.face.first[k] = run.first[k];
    line.face.step[k] = run.step[k];
  }
  return line;
}

}  // namespace sphparam
