#pragma once

#include <vector>

#include "bake/image_plan.h"
#include "image/image_codec.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

/// Bakes and draws the images into pending files, row by row, with the scales of heat maps beside
/// them. `texts`: metadata that all of them carry. Returns of each the share of its texels that
/// `BakedFile::share_beyond` tells. Throws: ImageError; WriteError; Cancelled.
std::vector<double> write_images(const std::vector<PlannedImage>& images, const BakeScene& scene,
                                 const BakeSettings& settings, const ImageTexts& texts,
                                 PendingFiles& files);

}  // namespace sphparam
