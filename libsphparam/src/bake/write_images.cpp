#include "bake/write_images.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "render/heat.h"
#include "sphparam/io/paths.h"
#include "srgb_curves.h"

namespace sphparam {
namespace {

/// The scale of a heat map, in a picture of its own: a texture has no place for it.
void add_scale(const PlannedImage& image, PendingFiles& files) {
  const HeatScale* const scale = image.field.scale.get();
  if (!scale || image.drawn || is_stream(image.request.path)) return;
  constexpr int side = 480;
  const Image blank(side, side, 3), whole = with_legend(blank, *scale);
  Image strip(whole.width, whole.height - side, whole.channels);
  std::copy_n(whole.pixel(0, side), strip.pixels.size(), strip.pixels.begin());
  const std::vector<char> png = encode_image(strip, ImageFormat::Png);
  files.add(scale_path(image.request.path), {png.data(), png.size()});
}

std::unique_ptr<BakedFile> open_file(const PlannedImage& image, const ImageTexts& texts,
                                     PendingFiles& files) {
  PendingFiles::Pieces pieces = files.open(image.request.path);
  BakedFileOptions options = image.file;
  options.metadata = texts;
  return std::make_unique<BakedFile>(image.field, options,
                                     ImagePlace{std::move(pieces.write), std::move(pieces.read)});
}

void draw(const PlannedImage& image, const BakeSettings& settings, BakedFile& file) {
  const SrgbCurves& curves = SrgbCurves::get();
  const int width = image.file.width, height = image.file.height;
  constexpr int rows_at_once = 64;
  for (int row = 0; row < height; row += rows_at_once) {
    const int rows = std::min(rows_at_once, height - row);
    std::vector<float> rgb(3 * static_cast<size_t>(rows) * static_cast<size_t>(width));
    draw_test_rows(*image.drawn, width, height, Convention::Sphparam, row, rows, rgb.data(),
                   settings.threads);
    for (float& x : rgb) x = curves.to_linear(x);
    file.write_rows(rows, rgb.data());
    report(settings.progress, image.field.name, static_cast<double>(row) / height);
  }
}

}  // namespace

std::string scale_path(const std::string& image) {
  const std::filesystem::path path(image);
  return (path.parent_path() / (path.stem().string() + "_scale.png")).string();
}

std::vector<double> write_images(const std::vector<PlannedImage>& images, const BakeScene& scene,
                                 const BakeSettings& settings, const ImageTexts& texts,
                                 PendingFiles& files) {
  std::vector<std::unique_ptr<BakedFile>> open;
  for (const PlannedImage& image : images) {
    open.push_back(open_file(image, texts, files));
    add_scale(image, files);
  }
  std::vector<SurfaceField> baked;
  std::vector<BakedFile*> files_of_baked;
  for (size_t i = 0; i < images.size(); ++i) {
    if (images[i].drawn) {
      draw(images[i], settings, *open[i]);
      continue;
    }
    baked.push_back(images[i].field);
    files_of_baked.push_back(open[i].get());
  }
  if (!baked.empty()) {
    bake(scene, baked, engine_options(settings, "bake"),
         [&](size_t i, int, int rows, const float* values) {
           files_of_baked[i]->write_rows(rows, values);
         });
  }
  std::vector<double> beyond;
  for (const auto& file : open) {
    report(settings.progress, "write", 0);
    file->close();
    beyond.push_back(file->share_beyond());
  }
  return beyond;
}

}  // namespace sphparam
