#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/image/image.h"
#include "texture/seen_texels.h"
#include "texture/source_texture.h"

namespace sphparam {

/// What the rows of an image are: alike, or parallels of a sphere, of which those near the poles
/// count less in means.
enum class ImageRows : std::uint8_t { Alike, Parallels };

/// The levels of an image, each half as wide and high down to one texel: means over boxes, in
/// linear light. Four channels of 16 bits a texel: linear red, green, blue, and alpha.
class TexturePyramid {
 public:
  /// Channels: 1 (grey), 2 (grey, alpha), 3 or 4, more are dropped; values in [0, 1], sRGB unless
  /// `linear`. Means are of the texels `seen` alone; what nobody sees takes the colour of what lies
  /// near. Requires: at least one texel; `seen` of the image's size, or of all.
  /// Cost: 11 bytes a texel, two more while it is made.
  explicit TexturePyramid(const Image& image, bool linear = false, int threads = 0,
                          const SeenTexels& seen = {}, ImageRows rows = ImageRows::Alike);

  struct Level {
    int width, height;
    std::vector<std::uint16_t> texels;  // 4·width·height, rows from the top
  };
  const std::vector<Level>& levels() const { return levels_; }
  bool has_alpha() const { return has_alpha_; }

 private:
  std::vector<Level> levels_;
  bool has_alpha_;
};

/// Where neighbouring samples of a row look an image up: sample i at first + i·step; `below` leads
/// to the row below. In [0, 1] of the image's width and height, y downwards from its top.
struct TextureLine {
  double first[2], step[2], below[2];
  int count;

  /// The face that the samples are on, by where its corners look; sample i has the barycentric
  /// weights first + i·step. Bit k of `seams`: beyond the side that faces corner k the image is of
  /// another place; bit 3 + k: it is unless it repeats.
  struct Face {
    unsigned seams = 0;
    double corners[3][2] = {};
    double first[3] = {}, step[3] = {};
  } face = {};
};

/// Linear red, green, blue and, of 4 channels, alpha of each sample, times the factor, to
/// values[0 … channels·count).
///
/// What a sample covers, the parallelogram of `step` and `below`, chooses the levels: linear
/// between two of them by its narrow side, several samples along its wide one, at most 16. Nearer
/// to a seam than half of that one sample does, of a level whose texels do not reach beyond. Where
/// texels are larger than samples the filter is as asked for, but `Nearest` for textures that want
/// it; `Nearest` that is asked for always looks up one texel.
void sample_texture(const SourceTexture& texture, TextureFilter filter, const TextureLine& line,
                    float* values, int channels = 4);

}  // namespace sphparam
