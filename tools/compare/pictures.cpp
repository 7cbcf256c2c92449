#include "compare/pictures.h"

#include <optional>

#include "image/image_codec.h"
#include "render/figure.h"
#include "render/vertex_normals.h"

namespace sphparam::tools {

namespace {

const Rgb red_of_folds(0.85F, 0.05F, 0.08F);

/// The file's colours of vertices, Uint8 or Float32; nothing if it has none.
std::optional<std::vector<Rgb>> own_colours(const MeshFile& file) {
  std::vector<Rgb> colours(static_cast<size_t>(file.mesh.vertex_count()));
  int channel = 0;
  for (const char* name : {"red", "green", "blue"}) {
    const Property* property = file.find_vertex_property(name);
    if (!property) return std::nullopt;
    const double full = property->type == ScalarType::Uint8 ? 255 : 1;
    for (size_t v = 0; v < colours.size(); ++v) {
      colours[v][channel] = static_cast<float>(property->values[v] / full);
    }
    ++channel;
  }
  return colours;
}

std::vector<Rgb> colours_of_directions(const TriangleMesh& mesh) {
  std::vector<Rgb> colours;
  const Points normals = vertex_normals(mesh);
  for (const auto& normal : normals.rowwise()) {
    colours.push_back((0.6 + 0.35 * normal.array()).cast<float>().matrix().transpose());
  }
  return colours;
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

PictureOptions seen_with_up(const Vector3& up) {
  PictureOptions options;
  options.up = up;
  if (up == Vector3::UnitY()) options.view = Vector3(1, 0.5, 1.6);
  return options;
}

Paint shape_paint(const MeshFile& file, const std::vector<Face>& red) {
  const std::optional<std::vector<Rgb>> own = own_colours(file);
  const std::vector<Rgb> colours = own ? *own : colours_of_directions(file.mesh);
  if (red.empty()) return VertexPaint{colours};
  FacePaint paint;
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    Rgb sum = Rgb::Zero();
    for (int k = 0; k < 3; ++k) sum += colours[static_cast<size_t>(file.mesh.triangles(f, k))];
    paint.colours.push_back(sum / 3);
  }
  for (const Face f : red) paint.colours[static_cast<size_t>(f)] = red_of_folds;
  return paint;
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

}  // namespace sphparam::tools
