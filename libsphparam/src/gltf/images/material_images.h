#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/image_codec.h"
#include "sphparam/gltf/asset.h"

namespace sphparam {

/// An image file as it is given, and as an asset has it.
struct GivenImage {
  AssetImage asset;
  Image pixels;
  ImageTexts texts;  // of its metadata
};

/// PNG, WebP and such JPEG as all viewers show stay as they are, after they were decoded once;
/// other JPEG, TIFF, BMP and TGA become PNG, floats of colours (`name`: basecolor, emissive) as
/// sRGB, of our normals as integers have them. Throws: ReadError, ImageError; also for EXR, whose
/// numbers no viewer shows, and for a JPEG that is cut off. `warnings` gets one where it is not
/// twice as wide as high, and where a JPEG does not stay.
GivenImage read_asset_image(const std::string& path, const std::string& name,
                            std::vector<std::string>& warnings);

/// What all pixels of an image have, of the channels of colours; grey thrice. Nothing where they
/// differ.
std::optional<std::array<float, 3>> uniform_colour(const Image& image);

/// How alpha is meant in an image that does not say it, as those of strangers: as a mask where it
/// is 0 or 1 everywhere, else blended. Opaque where there is none, where it is 1 everywhere, and
/// where it is 0 everywhere, which many programs write without meaning it.
AlphaMode alpha_mode_of(const Image& image);

/// Images of a folder by the names that `bake` gives them: NAME.png or anything-NAME, -_ before it.
struct BakedImages {
  std::string base_colour, normal, occlusion, orm, emissive;  // paths; empty: not there

  bool none() const {
    return base_colour.empty() && normal.empty() && occlusion.empty() && orm.empty() &&
           emissive.empty();
  }
};

/// Throws: ReadError where the folder cannot be read, holds none of them, or two of one kind.
BakedImages find_baked_images(const std::string& folder);

}  // namespace sphparam
