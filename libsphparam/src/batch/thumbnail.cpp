// Orthographic, a depth buffer of four samples a pixel, a flat colour a triangle.

#include "batch/thumbnail.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/files/png.h"
#include "mesh/triangle_geometry.h"
#include "render/heat.h"
#include "sphparam/io/up_axis.h"

namespace sphparam {

namespace {

constexpr int samples = 2;       // each way
constexpr double margin = 1.06;  // of the picture around what is drawn

/// What a triangle's area on the sphere is to that on the mesh, each as a share of the whole.
VectorX area_ratios(const TriangleMesh& mesh, const Points& rays) {
  const auto double_area = [&](const Points& points, Eigen::Index f) {
    return doubled_area(points.row(mesh.triangles(f, 0)), points.row(mesh.triangles(f, 1)),
                        points.row(mesh.triangles(f, 2)));
  };
  VectorX before(mesh.face_count()), after(mesh.face_count());
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    before[f] = double_area(mesh.positions, f);
    after[f] = double_area(rays, f);
  }
  return (after / after.sum()).cwiseQuotient(before / before.sum());
}

/// The mesh as its file says that it stands, z up.
Points standing(const MeshFile& file) {
  const UprightAxes axes = upright_axes(file);
  Eigen::Matrix3d rows;
  rows << axes.right().transpose(), -axes.front.transpose(), axes.up.transpose();
  return file.mesh.positions * rows.transpose();
}

/// A square picture that fills itself with triangles.
class Canvas {
 public:
  Canvas(int pixels, const Points& points)
      : side_(samples * pixels),
        depth_(static_cast<std::size_t>(side_) * side_, -std::numeric_limits<float>::infinity()),
        colour_(depth_.size(), Rgb(1, 1, 1)) {
    const Vector3 back = Vector3(1, -0.6, 0.45).normalized();
    const Vector3 right = Vector3::UnitZ().cross(back).normalized();
    axes_ << right.transpose(), back.cross(right).transpose(), back.transpose();
    projected_ = points * axes_.transpose();
    const Eigen::RowVector3d lower = projected_.colwise().minCoeff(),
                             upper = projected_.colwise().maxCoeff();
    const double size = margin * (upper - lower).head<2>().maxCoeff();
    const Eigen::RowVector3d middle = 0.5 * (lower + upper);
    projected_.rowwise() -= middle;
    projected_ *= size > 0 ? side_ / size : 1;
  }

  void fill(const std::array<Vertex, 3>& corners, const Rgb& colour) {
    std::array<Vector3, 3> p;
    for (int k = 0; k < 3; ++k) {
      const Vector3 q = projected_.row(corners[k]);
      p[k] = Vector3(q.x() + 0.5 * side_, 0.5 * side_ - q.y(), q.z());
    }
    const double twice_area = cross(p[0], p[1], p[2]);
    if (!(twice_area < 0)) return;  // seen from behind: y goes down
    const Rgb shaded = to_linear(colour) * static_cast<float>(light(p));
    const auto [left, right] = bounds(p[0].x(), p[1].x(), p[2].x());
    const auto [top, bottom] = bounds(p[0].y(), p[1].y(), p[2].y());
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) set(x, y, p, twice_area, shaded);
  }

  /// The mean light of a pixel.
  Rgb at(int x, int y) const {
    Rgb sum = Rgb::Zero();
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i) sum += colour_[index(samples * x + i, samples * y + j)];
    return sum / (samples * samples);
  }

 private:
  static double cross(const Vector3& a, const Vector3& b, const Vector3& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  }

  /// Brighter where it faces the eye, from the upper left.
  static double light(const std::array<Vector3, 3>& p) {
    const Vector3 normal = -(p[1] - p[0]).cross(p[2] - p[0]).normalized();
    return 0.35 + 0.65 * std::max(0.0, normal.dot(Vector3(-0.35, -0.45, 0.82)));
  }

  std::pair<int, int> bounds(double a, double b, double c) const {
    const auto whole = [&](double value) {
      return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(side_ - 1)));
    };
    return {whole(std::floor(std::min({a, b, c}))), whole(std::ceil(std::max({a, b, c})))};
  }

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * side_ + x; }

  void set(int x, int y, const std::array<Vector3, 3>& p, double twice_area, const Rgb& colour) {
    const Vector3 here(x + 0.5, y + 0.5, 0);
    const double a = cross(p[1], p[2], here) / twice_area, b = cross(p[2], p[0], here) / twice_area,
                 c = 1 - a - b;
    if (a < 0 || b < 0 || c < 0) return;
    const auto depth = static_cast<float>(a * p[0].z() + b * p[1].z() + c * p[2].z());
    float& nearest = depth_[index(x, y)];
    if (depth <= nearest) return;
    nearest = depth;
    colour_[index(x, y)] = colour;
  }

  int side_;
  Eigen::Matrix3d axes_;
  Points projected_;
  std::vector<float> depth_;
  std::vector<Rgb> colour_;
};

}  // namespace

std::string draw_thumbnail(const DrawnMesh& drawn, int pixels) {
  const TriangleMesh& mesh = drawn.file.mesh;
  const Points& rays = drawn.map.value().points;
  const VectorX ratios = area_ratios(mesh, rays);
  std::array<Canvas, 2> canvases = {Canvas(pixels, standing(drawn.file)), Canvas(pixels, rays)};
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    const std::array<Vertex, 3> corners = {mesh.triangles(f, 0), mesh.triangles(f, 1),
                                           mesh.triangles(f, 2)};
    const Rgb colour = heat_colour(Heat::Area, ratios[f]);
    for (Canvas& canvas : canvases) canvas.fill(corners, colour);
  }
  std::string bytes;
  for (int y = 0; y < pixels; ++y)
    for (const Canvas& canvas : canvases)
      for (int x = 0; x < pixels; ++x) {
        const Rgb colour = to_srgb(canvas.at(x, y));
        for (int k = 0; k < 3; ++k) bytes += static_cast<char>(std::lround(255 * colour[k]));
      }
  return png_bytes(bytes, 2 * pixels, pixels);
}

}  // namespace sphparam
