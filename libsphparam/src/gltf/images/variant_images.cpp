#include "gltf/images/variant_images.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "image/image_writer.h"

// A large image takes seconds to encode: it is made some rows at a time, and may be cancelled
// between them.

namespace sphparam {

namespace {

constexpr int rows_at_once = 64;

/// Of 8 bits; texels in [0, 1].
std::vector<std::uint8_t> bytes_of(const float* values, std::size_t count) {
  std::vector<std::uint8_t> bytes(count);
  std::transform(values, values + count, bytes.begin(), [](float x) {
    return x > 0 ? static_cast<std::uint8_t>(std::min(x, 1.0F) * 255 + 0.5F) : std::uint8_t{0};
  });
  return bytes;
}

struct PngSize {
  int width, height, channels;
};

/// Of what `rows_from` gives: rows · width · channels values from a first row on.
AssetImage png_of_rows(const std::string& name, const PngSize& size, const Progress& progress,
                       const std::function<const float*(int first_row, int rows)>& rows_from) {
  const std::string stage = "image " + name;
  std::vector<char> png;
  ImageWriter writer({.width = size.width, .height = size.height, .channels = size.channels},
                     in_memory(png));
  for (int row = 0; row < size.height; row += rows_at_once) {
    report(progress, stage, static_cast<double>(row) / size.height);
    const int rows = std::min(rows_at_once, size.height - row);
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(size.width) *
                       static_cast<std::size_t>(size.channels);
    writer.write_rows(bytes_of(rows_from(row, rows), count).data(), rows);
  }
  writer.close();
  return {name, {png.begin(), png.end()}};
}

}  // namespace

AssetImage as_png(const std::string& name, const Image& image, const Progress& progress) {
  return png_of_rows(name, {image.width, image.height, image.channels}, progress,
                     [&](int row, int) { return image.pixel(0, row); });
}

AssetImage test_asset_image(TestImage image, int width, Convention convention, int threads,
                            const Progress& progress) {
  const int height = std::max(1, width / 2);
  std::vector<float> drawn(std::size_t{3} * rows_at_once * static_cast<std::size_t>(width));
  return png_of_rows(name_of(image), {width, height, 3}, progress, [&](int row, int rows) {
    draw_test_rows(image, width, height, convention, row, rows, drawn.data(), threads);
    return drawn.data();
  });
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
