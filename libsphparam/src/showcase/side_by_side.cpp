#include "showcase/side_by_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "elementary.h"

// Seen in parallel, what moves towards the eye stays where it is in the picture: links stand before
// both objects.

namespace sphparam {
namespace {

constexpr double margin = 1.06;  // of the picture around what is drawn
constexpr double gap = 0.12;     // between the objects, of their greatest height
constexpr double thickness = 0.0035, least_thickness = 1.4;  // of the height; pixels
constexpr double knob = 3;                                   // at their ends, in thicknesses
constexpr int sides = 6;                                     // of links

/// The directions of a picture, and how far something reaches in them.
struct Axes {
  Vector3 right, up, back;

  explicit Axes(const PairLook& look) {
    back = look.view.normalized();
    right = look.up.cross(back).normalized();
    up = back.cross(right);
  }
};

struct Extent {
  double low, high;
  double length() const { return high - low; }
  double middle() const { return (low + high) / 2; }
};

Extent extent_of(const TriangleMesh& mesh, const Vector3& axis) {
  const VectorX along = mesh.positions * axis;
  return {along.minCoeff(), along.maxCoeff()};
}

void shift(TriangleMesh& mesh, const Vector3& by) { mesh.positions.rowwise() += by.transpose(); }

void append(TriangleMesh& mesh, const std::vector<Vector3>& points,
            const std::vector<std::array<int, 3>>& triangles) {
  const Eigen::Index vertices = mesh.positions.rows(), faces = mesh.triangles.rows();
  mesh.positions.conservativeResize(vertices + std::ssize(points), 3);
  mesh.triangles.conservativeResize(faces + std::ssize(triangles), 3);
  for (Eigen::Index i = 0; i < std::ssize(points); ++i)
    mesh.positions.row(vertices + i) = points[static_cast<size_t>(i)];
  for (Eigen::Index i = 0; i < std::ssize(triangles); ++i)
    for (int k = 0; k < 3; ++k)
      mesh.triangles(faces + i, k) =
          static_cast<int>(vertices) + triangles[static_cast<size_t>(i)][static_cast<size_t>(k)];
}

/// A prism round the way from one point to another.
void append_tube(TriangleMesh& mesh, const Vector3& from, const Vector3& to, double radius) {
  const Vector3 way = to - from;
  const Vector3 across = way.unitOrthogonal(), other = way.normalized().cross(across);
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const Vector3 out = radius * (elementary::cos(angle) * across + elementary::sin(angle) * other);
    points.push_back(from + out);
    points.push_back(to + out);
    const int a = 2 * i, b = 2 * ((i + 1) % sides);
    triangles.push_back({a, b, b + 1});
    triangles.push_back({a, b + 1, a + 1});
  }
  append(mesh, points, triangles);
}

/// An octahedron: a dot in the picture.
void append_knob(TriangleMesh& mesh, const Vector3& at, double radius, const Axes& axes) {
  std::vector<Vector3> points;
  for (const Vector3& axis : {axes.right, axes.up, axes.back})
    for (const double sign : {1.0, -1.0}) points.push_back(at + sign * radius * axis);
  append(mesh, points,
         {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

/// All links as one object; `radius` of a link.
RenderObject links_object(const std::vector<Link>& links, double radius, const Axes& axes) {
  RenderObject object{.mesh = {Points(0, 3), Triangles(0, 3)}, .shading = Shading::Flat};
  VertexPaint paint;
  for (const Link& link : links) {
    append_tube(object.mesh, link.from, link.to, radius);
    append_knob(object.mesh, link.from, knob * radius, axes);
    append_knob(object.mesh, link.to, knob * radius, axes);
    paint.colours.resize(static_cast<size_t>(object.mesh.vertex_count()), link.colour);
  }
  object.paint = std::move(paint);
  return object;
}

/// How far each object moves so that they stand beside each other, centred on the origin.
std::array<Vector3, 2> places(const TriangleMesh& left, const TriangleMesh& right,
                              const Axes& axes) {
  std::array<Vector3, 2> shifts;
  const std::array<const TriangleMesh*, 2> meshes = {&left, &right};
  const double height =
      std::max(extent_of(left, axes.up).length(), extent_of(right, axes.up).length());
  for (size_t i = 0; i < 2; ++i) {
    const Extent across = extent_of(*meshes[i], axes.right), up = extent_of(*meshes[i], axes.up),
                 back = extent_of(*meshes[i], axes.back);
    const double edge = i == 0 ? -gap / 2 * height - across.high : gap / 2 * height - across.low;
    shifts[i] = edge * axes.right - up.middle() * axes.up - back.middle() * axes.back;
  }
  return shifts;
}

/// Both objects, their shifts made, seen whole.
RenderScene scene_of(RenderObject left, RenderObject right, const Axes& axes,
                     const PairLook& look) {
  const Extent first = extent_of(left.mesh, axes.right), second = extent_of(right.mesh, axes.right);
  const double height =
      std::max(extent_of(left.mesh, axes.up).length(), extent_of(right.mesh, axes.up).length());
  const double width = second.high - first.low;
  RenderScene scene;
  scene.camera.height = margin * std::max(height, width / 3);
  scene.camera.target = (first.low + second.high) / 2 * axes.right;
  scene.camera.direction = axes.back;
  scene.camera.up = axes.up;
  scene.height = look.size;
  scene.width = static_cast<int>(
      std::lround(look.size * std::max(2.0, margin * width / scene.camera.height)));
  scene.background = look.background;
  scene.objects.push_back(std::move(left));
  scene.objects.push_back(std::move(right));
  return scene;
}

}  // namespace

Image side_by_side(RenderObject left, RenderObject right, const std::vector<Link>& links,
                   const PairLook& look) {
  const Axes axes(look);
  const auto [to_left, to_right] = places(left.mesh, right.mesh, axes);
  shift(left.mesh, to_left);
  shift(right.mesh, to_right);
  const double depth =
      std::max(extent_of(left.mesh, axes.back).high, extent_of(right.mesh, axes.back).high);
  RenderScene scene = scene_of(std::move(left), std::move(right), axes, look);
  std::vector<Link> before = links;
  for (Link& link : before) {
    const auto lifted = [&](const Vector3& point) -> Vector3 {
      return point + (2 * depth - point.dot(axes.back)) * axes.back;
    };
    link.from = lifted(link.from + to_left);
    link.to = lifted(link.to + to_right);
  }
  const double pixels = std::max(thickness * look.size, least_thickness);
  const double radius = pixels / 2 * scene.camera.height / look.size;
  if (!before.empty()) scene.objects.push_back(links_object(before, radius, axes));
  return render(scene, look.threads);
}

}  // namespace sphparam
