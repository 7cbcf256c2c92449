// contact_sheet SHEET.png IMAGE…: many images, small and with their names, on one sheet.

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "image/image_codec.h"
#include "render/lettering.h"

namespace {

using sphparam::Image;
using sphparam::Rgb;

constexpr char usage[] =
    "Put images on one sheet, to be looked at together.\n"
    "\n"
    "  contact_sheet sheet.png baked/*.png\n";

constexpr int column_count = 4, full_width = 480, full_height = 240, gap = 16, dot = 2;

/// The mean of the pixels that a smaller one covers; images of one or two channels become grey.
Rgb mean_colour(const Image& image, double x0, double y0, double x1, double y1) {
  Rgb sum = Rgb::Zero();
  float count = 0;
  const auto last = [](double end, int size) {
    return std::min(size, std::max(1, static_cast<int>(end)));
  };
  const int right = last(x1, image.width), bottom = last(y1, image.height);
  for (int y = std::min(static_cast<int>(y0), bottom - 1); y < bottom; ++y) {
    for (int x = std::min(static_cast<int>(x0), right - 1); x < right; ++x, ++count) {
      const float* pixel = image.pixel(x, y);
      for (int c = 0; c < 3; ++c) sum[c] += pixel[image.channels < 3 ? 0 : c];
    }
  }
  return sum / count;
}

/// Fits the image into its place, as large as it goes.
void paste(Image& sheet, const Image& image, int left, int top) {
  const double scale = std::min(static_cast<double>(full_width) / image.width,
                                static_cast<double>(full_height) / image.height);
  const int width = std::max(1, static_cast<int>(scale * image.width)),
            height = std::max(1, static_cast<int>(scale * image.height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Rgb colour = mean_colour(image, x / scale, y / scale, (x + 1) / scale, (y + 1) / scale);
      std::copy_n(colour.data(), 3, sheet.pixel(left + x, top + y));
    }
  }
}

std::string label_of(const std::string& path) {
  std::string label = std::filesystem::path(path).stem().string();
  std::ranges::replace(label, '_', ' ');
  std::ranges::transform(label, label.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return label;
}

Image sheet_of(const std::vector<std::string>& paths) {
  const int count = static_cast<int>(paths.size());
  const int columns = std::min(column_count, count), rows = (count + columns - 1) / columns;
  const int line = sphparam::text_height(dot) + gap / 2;
  Image sheet(gap + columns * (full_width + gap), gap + rows * (full_height + line + gap), 3);
  std::ranges::fill(sheet.pixels, 1.0F);
  for (int i = 0; i < count; ++i) {
    const int left = gap + i % columns * (full_width + gap);
    const int top = gap + i / columns * (full_height + line + gap);
    const std::string& path = paths[static_cast<size_t>(i)];
    draw_text(sheet, label_of(path), left, top, dot, Rgb::Constant(0.15F));
    paste(sheet, sphparam::read_image(path), left, top + line);
  }
  return sheet;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs(usage, stderr);
    return 2;
  }
  try {
    sphparam::write_image(argv[1], sheet_of({argv + 2, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "contact_sheet: %s\n", error.what());
    return 3;
  }
}
