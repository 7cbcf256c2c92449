#include "render/figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary.h"
#include "io/attributes/shading_normals.h"
#include "render/drawing_size.h"
#include "render/geodesic.h"
#include "render/own_paint.h"

// The sphere is turned so that the pictures correspond: its side towards the eye is the mean ray of
// the triangles that face the eye on the mesh, and its up the way that this mean moves with height.

namespace sphparam {
namespace {

constexpr double long_lens = 18;  // degrees: a long lens
constexpr double margin = 1.08;   // of the picture around what is drawn

RenderScene scene_of(RenderObject object, const Vector3& direction, const Vector3& up,
                     const FigureOptions& options) {
  const Vector3 low = object.mesh.positions.colwise().minCoeff();
  const Vector3 high = object.mesh.positions.colwise().maxCoeff();
  RenderScene scene;
  scene.camera = {(low + high) / 2, direction, up, 2, long_lens};
  scene.width = scene.height = options.size;
  scene.samples = options.samples;
  scene.background = options.background;
  scene.objects.push_back(std::move(object));
  return scene;
}

/// Moves the camera so that the whole object is seen, and as large as possible.
void fit_camera(RenderScene& scene) {
  Camera& camera = scene.camera;
  const Vector3 back = camera.direction.normalized();
  const Vector3 right = camera.up.cross(back).normalized(), up = back.cross(right);
  const Points& points = scene.objects[0].mesh.positions;
  const auto middle = [&](const Vector3& axis) {
    const VectorX along = points * axis;
    return (along.minCoeff() + along.maxCoeff()) / 2 * axis;
  };
  camera.target = middle(right) + middle(up) + middle(back);
  // tan of half the field: what is nearer looks larger.
  const double spread = 2 * elementary::tan(camera.field_of_view * std::numbers::pi / 360);
  double height = 0;
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const Vector3 p = points.row(v).transpose() - camera.target;
    const double across = 2 * std::max(std::abs(p.dot(right)), std::abs(p.dot(up)));
    height = std::max(height, across + spread * p.dot(back));
  }
  camera.height = margin * height;
}

/// The whole unit sphere, also where a map covers only a part of it.
void fit_camera_to_sphere(RenderScene& scene) {
  const double spread = 2 * elementary::tan(scene.camera.field_of_view * std::numbers::pi / 360);
  scene.camera.target = Vector3::Zero();
  scene.camera.height = margin * elementary::hypot(2, spread);  // max of 2 sin t + spread cos t
}

}  // namespace

SphereView corresponding_view(const TriangleMesh& mesh, const SphereMap& map, const Vector3& from,
                              const Vector3& up) {
  const Vector3 view = from.normalized();
  Vector3 rays = Vector3::Zero(), rising = Vector3::Zero();
  double weights = 0, heights = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const Vector3 a = mesh.position(mesh.triangles(f, 0)), b = mesh.position(mesh.triangles(f, 1)),
                  c = mesh.position(mesh.triangles(f, 2));
    const double weight = std::max(0.0, (b - a).cross(c - a).dot(view));
    const double height = (a + b + c).dot(up) / 3;
    const Vector3 ray = map.point(mesh.triangles(f, 0)) + map.point(mesh.triangles(f, 1)) +
                        map.point(mesh.triangles(f, 2));
    weights += weight, heights += weight * height;
    rays += weight * ray, rising += weight * height * ray;
  }
  // Σ w (height − mean height) ray
  rising -= heights / std::max(weights, 1e-300) * rays;
  if (!(rays.norm() > 0)) rays = view;
  if (!(rays.cross(rising).norm() > 0)) rising = rays.unitOrthogonal();
  return {rays.normalized(), rising};
}

Image in_a_row(const std::vector<Image>& images) {
  int width = 0;
  for (const Image& image : images) width += image.width;
  Image row(width, images.front().height, images.front().channels);
  for (int y = 0; y < row.height; ++y) {
    float* out = row.pixel(0, y);
    for (const Image& image : images) {
      out = std::copy_n(image.pixel(0, y), image.width * image.channels, out);
    }
  }
  return row;
}

Image map_figure(const MeshFile& file, const SphereMap& map, const FigureOptions& options,
                 int threads) {
  RenderObject object = {.mesh = at_drawing_size(file.mesh),
                         .normals = shading_normals(file),
                         .paint = options.paint ? *options.paint : own_paint(file)};
  object.corner_normals = corner_shading_normals(file, *object.normals);
  if (options.graticule) object.graticule = Graticule{.rays = map.points};
  if (options.wireframe) object.wireframe = Wireframe{};
  std::vector<RenderScene> scenes;
  if (options.with_mesh) {
    scenes.push_back(scene_of(object, options.view, options.up, options));
    scenes.back().objects[0].occlusion = true;
    fit_camera(scenes.back());
  }
  if (options.with_sphere) {
    const RenderObject sphere = on_sphere(object, map.points);
    const SphereView side = corresponding_view(object.mesh, map, options.view, options.up);
    scenes.push_back(scene_of(sphere, side.direction, side.up, options));
    fit_camera_to_sphere(scenes.back());
    if (options.both_sides) {
      scenes.push_back(scene_of(sphere, -side.direction, side.up, options));
      fit_camera_to_sphere(scenes.back());
    }
  }
  std::vector<Image> images;
  for (const RenderScene& scene : scenes) images.push_back(render(scene, threads));
  return in_a_row(images);
}

}  // namespace sphparam
