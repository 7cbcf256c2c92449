#include "gltf/images/variant_images.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "image/image_writer.h"
#include "io/files/png.h"

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

/// Pictures of our own: to open OpenImageIO for them takes as long as half an export.
AssetImage own_png(const std::string& name, std::string_view pixels, int width, int height) {
  return {name, png_bytes(pixels, width, height)};
}

}  // namespace

AssetImage as_png(const std::string& name, const Image& image, const Progress& progress) {
  const std::string stage = "image " + name;
  std::vector<char> png;
  ImageWriter writer({.width = image.width, .height = image.height, .channels = image.channels},
                     in_memory(png));
  for (int row = 0; row < image.height; row += rows_at_once) {
    report(progress, stage, static_cast<double>(row) / image.height);
    const int rows = std::min(rows_at_once, image.height - row);
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(image.width) *
                       static_cast<std::size_t>(image.channels);
    writer.write_rows(bytes_of(image.pixel(0, row), count).data(), rows);
  }
  writer.close();
  return {name, {png.begin(), png.end()}};
}

AssetImage test_asset_image(TestImage image, int width, Convention convention, int threads,
                            const Progress& progress) {
  const int height = std::max(1, width / 2);
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(width);
  std::vector<float> drawn(rows_at_once * row_bytes);
  std::string bytes;
  for (int row = 0; row < height; row += rows_at_once) {
    report(progress, "image " + std::string(name_of(image)), static_cast<double>(row) / height);
    const int rows = std::min(rows_at_once, height - row);
    draw_test_rows(image, width, height, convention, row, rows, drawn.data(), threads);
    const auto values = bytes_of(drawn.data(), static_cast<std::size_t>(rows) * row_bytes);
    bytes.append(values.begin(), values.end());
  }
  return own_png(name_of(image), bytes, width, height);
}

AssetImage white_asset_image() { return own_png("white", "\xff\xff\xff", 1, 1); }

AssetImage flat_normals_image() { return own_png("flat_normals", "\x80\x80\xff", 1, 1); }

Image in_convention(const Image& image, Convention convention) {
  Image moved(image.width, image.height, image.channels);
  moved.pixels =
      in_convention(convention, image.width, image.channels, image.height, image.pixels.data());
  return moved;
}

}  // namespace sphparam
