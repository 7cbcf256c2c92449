#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "sphparam/image/image_format.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/texture/convention.h"

namespace sphparam {

/// The levels of an image; inside the library only.
class TexturePyramid;

/// Looks an equirectangular image up by direction: periodic in longitude, and over a pole it goes
/// on on the other side, half a turn away. Copies share the pixels.
///
/// A lookup has a size, the width of what it stands for on the sphere. Where texels are larger it
/// is bilinear; where they are smaller it is the mean of as many as that width holds: by the levels
/// of the pyramid in latitude, and by several samples in longitude, as towards the poles more and
/// more texels of a row lie within one width. Our own.
class EquirectangularImage {
 public:
  /// Shares the pyramid.
  EquirectangularImage(std::shared_ptr<const TexturePyramid> pyramid, Convention convention,
                       std::string warning = {}, std::string rays = {})
      : pyramid_(std::move(pyramid)),
        convention_(info_of(convention)),
        warning_(std::move(warning)),
        rays_(std::move(rays)) {}
  /// The pyramid outlives it.
  EquirectangularImage(const TexturePyramid& pyramid, Convention convention)
      : pyramid_(std::shared_ptr<void>(), &pyramid), convention_(info_of(convention)) {}

  /// Linear red, green, blue and alpha in the direction, of any length but 0; `width` in radians.
  /// Cost: 50 ns, 1/sin ϕ times that where texels are smaller than the width.
  std::array<float, 4> look_up(const Vector3& direction, double width) const;

  int width() const;   // texels
  int height() const;  // half the width, if it is of the whole sphere
  bool has_alpha() const;
  /// What its file has that is not heeded or cut off (a colour profile, values outside of 0 to 1),
  /// or that is measured and no colour; empty: nothing.
  const std::string& warning() const { return warning_; }
  /// Which map its file says that it was baked on, as the text "sphparam:rays" has it; empty: none.
  const std::string& rays() const { return rays_; }

 private:
  std::shared_ptr<const TexturePyramid> pyramid_;
  ConventionInfo convention_;
  std::string warning_, rays_;
};

/// The warning for people that an image is not twice as wide as high, as one of the whole sphere
/// is, or that it is of nodes, 2H − 1 wide; empty: it is neither, or misses that by one texel.
std::string warning_of_shape(const std::string& path, int width, int height);

/// An image that says it was baked in another convention than the one it is to be read in.
class ImageOfOtherConvention : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Reads an image: floats (EXR, TIFF) are linear light, integers sRGB.
/// Throws: ImageError, also where what is measured (heights in metres) stands in its pixels, not
/// colours: outside of 0 to 1 in more than 1 % of them, of an EXR in more than half, or greys of 16
/// bits that end below a quarter of white;
/// ImageOfOtherConvention. Cost: 11 bytes a texel.
EquirectangularImage read_equirectangular(const std::string& path,
                                          Convention convention = Convention::Sphparam,
                                          int threads = 0);

}  // namespace sphparam
