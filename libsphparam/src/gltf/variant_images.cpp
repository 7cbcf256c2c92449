#include "gltf/variant_images.h"

#include <vector>

#include "image/image_codec.h"

namespace sphparam {

AssetImage as_png(const std::string& name, const Image& image) {
  const std::vector<char> png = encode_image(image, ImageFormat::Png);
  return {name, {png.begin(), png.end()}};
}

AssetImage test_asset_image(TestImage image, int width, Convention convention, int threads) {
  return as_png(name_of(image), make_test_image(image, width, convention, threads));
}

AssetImage white_asset_image() {
  Image white(1, 1, 3);
  white.pixels.assign(3, 1.0F);
  return as_png("white", white);
}

AssetImage flat_normals_image() {
  Image flat(1, 1, 3);
  flat.pixels = {0.5F, 0.5F, 1.0F};
  return as_png("flat_normals", flat);
}

Image in_convention(const Image& image, Convention convention) {
  Image moved(image.width, image.height, image.channels);
  moved.pixels =
      in_convention(convention, image.width, image.channels, image.height, image.pixels.data());
  return moved;
}

}  // namespace sphparam
