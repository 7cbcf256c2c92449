#pragma once

#include <string>

#include "sphparam/gltf/asset.h"
#include "sphparam/image/image.h"
#include "sphparam/progress.h"
#include "texture/test_images.h"

namespace sphparam {

/// `progress` is told of its rows as "image NAME". Throws: ImageError; Cancelled.
AssetImage as_png(const std::string& name, const Image& image, const Progress& progress = {});

/// A test image, `width` texels wide. Throws: as `as_png`.
AssetImage test_asset_image(TestImage image, int width, Convention convention, int threads = 0,
                            const Progress& progress = {});

/// One white texel: the base colour image of a mesh whose colours are those of its vertices.
/// Without an image bound, exporters and validators take texture coordinates for unused and drop
/// them.
AssetImage white_asset_image();

/// One texel of a tangent-space normal map that changes nothing.
AssetImage flat_normals_image();

/// An equirectangular image of u = θ/2π with its columns where the convention has them.
/// Requires: a width that is a multiple of 4.
Image in_convention(const Image& image, Convention convention);

}  // namespace sphparam
