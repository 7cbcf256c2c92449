#pragma once

#include <string>
#include <vector>

#include "image/image_codec.h"
#include "sphparam/gltf/asset.h"

namespace sphparam {

/// An image file: PNG, JPEG and WebP as they are, after they were decoded once; TIFF, BMP and TGA
/// become PNG. Throws: ReadError, ImageError; also for EXR, whose numbers no viewer shows. `texts`
/// gets the texts of its metadata, `warnings` one where it is not twice as wide as high.
AssetImage read_asset_image(const std::string& path, const std::string& name, ImageTexts& texts,
                            std::vector<std::string>& warnings);

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
