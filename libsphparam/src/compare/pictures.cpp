#include "compare/pictures.h"

#include <utility>
#include <variant>

#include "image/image_codec.h"
#include "render/figure.h"
#include "render/own_paint.h"

namespace sphparam {

namespace {

const Rgb red_of_folds(0.85F, 0.05F, 0.08F);

/// Triangles have one colour each, the mean of their corners'.
FacePaint with_red(const VertexPaint& paint, const TriangleMesh& mesh,
                   const std::vector<Face>& red) {
  FacePaint faces;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    Rgb sum = Rgb::Zero();
    for (int k = 0; k < 3; ++k) sum += paint.colours[static_cast<size_t>(mesh.triangles(f, k))];
    faces.colours.push_back(sum / 3);
  }
  for (const Face f : red) faces.colours[static_cast<size_t>(f)] = red_of_folds;
  return faces;
}

/// Red is one texture more, of one colour.
TexturePaint with_red(TexturePaint paint, const TriangleMesh& mesh, const std::vector<Face>& red) {
  const Rgb colour = to_linear(red_of_folds);
  if (paint.texture_of.empty()) paint.texture_of.assign(static_cast<size_t>(mesh.face_count()), 0);
  for (const Face f : red) {
    paint.texture_of[static_cast<size_t>(f)] = static_cast<int>(paint.textures.size());
  }
  paint.textures.push_back({.factor = {colour[0], colour[1], colour[2], 1}});
  return paint;
}

FigureOptions figure_options(const Paint& paint, const PictureOptions& options) {
  FigureOptions figure;
  figure.paint = paint;
  figure.graticule = false;
  figure.wireframe = options.wireframe;
  figure.size = options.size;
  figure.view = options.view;
  figure.up = options.up;
  if (options.transparent) figure.background = std::nullopt;
  return figure;
}

}  // namespace

PictureOptions seen_upright(const UprightAxes& axes) {
  PictureOptions options;
  options.up = axes.up;
  options.view = axes.right() + 0.5 * axes.up + 1.6 * axes.front;
  return options;
}

Paint shape_paint(const MeshFile& file, const std::vector<Face>& red,
                  const MeshTextures& textures) {
  Paint paint = own_paint(file, textures);
  if (red.empty()) return paint;
  if (auto* texture = std::get_if<TexturePaint>(&paint)) {
    return with_red(std::move(*texture), file.mesh, red);
  }
  return with_red(std::get<VertexPaint>(paint), file.mesh, red);
}

Image mesh_picture(const MeshFile& file, const Paint& paint, const PictureOptions& options) {
  FigureOptions figure = figure_options(paint, options);
  figure.with_sphere = false;
  return map_figure(file, {}, figure, options.threads);
}

Image sphere_picture(const MeshFile& file, const SphereMap& map, const Paint& paint,
                     const PictureOptions& options) {
  FigureOptions figure = figure_options(paint, options);
  figure.with_mesh = false;
  return map_figure(file, map, figure, options.threads);
}

std::string png(const Image& image) {
  const std::vector<char> bytes = encode_image(image, ImageFormat::Png);
  return {bytes.begin(), bytes.end()};
}

}  // namespace sphparam
