#include "showcase/model.h"

#include <cmath>
#include <numbers>

#include "compare/pictures.h"
#include "embedding/frame/landmarks.h"
#include "gltf/chart_surface.h"
#include "gltf/fillers_left_out.h"
#include "render/drawing_size.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/io/fillers.h"

// A map is free to turn its sphere; for the eye it is turned back, so that head stays head and the
// morph is short.

namespace sphparam {
namespace {

/// Turns the sphere towards where its points lie on the mesh, seen from the middle.
Shape turned_like(const Shape& mesh, const Vector3& middle, Shape sphere) {
  std::vector<Pin> pins;
  for (Eigen::Index w = 0; w < mesh.positions.rows(); ++w) {
    const Vector3 arm = mesh.positions.row(w).transpose() - middle;
    const double length = arm.norm();
    if (length > 0) pins.push_back({static_cast<Vertex>(w), arm / length});
  }
  const Eigen::Matrix3d rotation = best_rotation({sphere.positions}, pins);
  const auto turn = [&](auto&& rows) { rows = (rows * rotation.transpose()).eval(); };
  turn(sphere.positions);
  turn(sphere.frame.normals);
  turn(sphere.frame.tangents.leftCols<3>());
  return sphere;
}

}  // namespace

std::string showcase_model(const std::string& name, const MeshFile& file,
                           const SphericalChart& chart, const Points& normals,
                           const std::vector<PaintedSurface>& surfaces, const UprightAxes& up,
                           int threads) {
  const Shape mesh = mesh_shape(chart, at_drawing_size(file.mesh), normals, up, threads);
  const Vector3 middle = middle_of(mesh);
  const double radius = std::sqrt(area_of(mesh, chart, threads) / (4 * std::numbers::pi));
  const Shape sphere =
      placed(turned_like(mesh, middle, sphere_shape(chart, {0, -1, 0}, threads)), radius, middle);
  Surface surface = chart_surface(chart, mesh, {{"sphere", sphere}}, file, {.threads = threads});
  leave_out(surface, fillers_of_chart(chart, fillers_of(file)));
  Asset asset{
      .name = name, .levels = {std::move(surface)}, .images = {}, .materials = {}, .extras = {}};
  for (const PaintedSurface& paint : surfaces) {
    asset.materials.push_back(
        {.name = paint.name, .base_colour = static_cast<int>(asset.images.size())});
    asset.images.push_back({paint.name, png(paint.image)});
  }
  return glb_bytes(asset);
}

}  // namespace sphparam
