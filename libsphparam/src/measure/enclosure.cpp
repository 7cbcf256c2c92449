// A tree of clusters: faces halved at the median of their middles along the longest side of these.
// A cluster is far where the point is farther than `far` radii from its middle.

#include "measure/enclosure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "sphere/solid_angle.h"

namespace sphparam {

namespace {

constexpr std::size_t most_faces = 8;  // of a cluster that is not cut
constexpr double far = 2;              // times the radius
constexpr double whole = 0.25;         // farther from a whole number, a sum is not to be trusted

Vector3 middle_of(const TriangleMesh& mesh, Face face) {
  return (mesh.position(mesh.triangles(face, 0)) + mesh.position(mesh.triangles(face, 1)) +
          mesh.position(mesh.triangles(face, 2))) /
         3;
}

Vector3 area_of(const TriangleMesh& mesh, Face face) {
  const Vector3 a = mesh.position(mesh.triangles(face, 0));
  return (mesh.position(mesh.triangles(face, 1)) - a)
             .cross(mesh.position(mesh.triangles(face, 2)) - a) /
         2;
}

}  // namespace

std::int64_t unclosed_edges(const Triangles& triangles) {
  struct Side {
    Vertex low, high;
    int way;
  };
  std::vector<Side> sides;
  sides.reserve(static_cast<std::size_t>(triangles.size()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vertex a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  }
  const auto edge = [](const Side& side) { return std::pair(side.low, side.high); };
  std::ranges::sort(sides, {}, edge);
  std::int64_t unclosed = 0;
  for (auto side = sides.begin(); side != sides.end();) {
    int sum = 0;
    const auto same = edge(*side);
    for (; side != sides.end() && edge(*side) == same; ++side) sum += side->way;
    unclosed += sum != 0;
  }
  return unclosed;
}

Enclosure::Enclosure(const TriangleMesh& mesh)
    : mesh_(mesh), faces_(static_cast<std::size_t>(mesh.face_count())) {
  std::iota(faces_.begin(), faces_.end(), 0);
  if (!faces_.empty()) add_cluster(0, faces_.size());
}

void Enclosure::add_cluster(std::size_t first, std::size_t last) {
  Cluster cluster{Vector3::Zero(), Vector3::Zero(), 0, first, last, 0};
  Vector3 low = middle_of(mesh_, faces_[first]), high = low;
  double size = 0;
  for (std::size_t i = first; i < last; ++i) {
    const Vector3 middle = middle_of(mesh_, faces_[i]), area = area_of(mesh_, faces_[i]);
    cluster.middle += area.norm() * middle;
    cluster.area += area;
    size += area.norm();
    low = low.cwiseMin(middle), high = high.cwiseMax(middle);
  }
  cluster.middle = size > 0 ? Vector3(cluster.middle / size) : Vector3((low + high) / 2);
  for (std::size_t i = first; i < last; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 corner = mesh_.position(mesh_.triangles(faces_[i], k));
      cluster.radius = std::max(cluster.radius, (corner - cluster.middle).norm());
    }
  }
  const std::size_t index = clusters_.size();
  clusters_.push_back(cluster);
  if (last - first <= most_faces) return;
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t half = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return faces_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(half), at(last), [&](Face a, Face b) {
    return std::pair(middle_of(mesh_, a)[axis], a) < std::pair(middle_of(mesh_, b)[axis], b);
  });
  add_cluster(first, half);
  clusters_[index].second_half = clusters_.size();
  add_cluster(half, last);
}

/// Sum of solid angles.
double Enclosure::face_by_face(std::size_t first, std::size_t last, const Vector3& point) const {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) {
    const auto ray = [&](int k) -> Vector3 {
      return (mesh_.position(mesh_.triangles(faces_[i], k)) - point).normalized();
    };
    sum += solid_angle(ray(0), ray(1), ray(2));
  }
  return sum;
}

double Enclosure::far_or_near(std::size_t index, const Vector3& point) const {
  const Cluster& cluster = clusters_[index];
  const Vector3 way = cluster.middle - point;
  const double distance = way.norm();
  if (distance > far * cluster.radius)
    return cluster.area.dot(way) / (distance * distance * distance);
  if (cluster.second_half == 0) return face_by_face(cluster.first, cluster.last, point);
  return far_or_near(index + 1, point) + far_or_near(cluster.second_half, point);
}

bool Enclosure::holds(const Vector3& point) const {
  if (clusters_.empty()) return false;
  constexpr double sphere = 4 * std::numbers::pi;
  double winding = far_or_near(0, point) / sphere;
  if (!(std::abs(winding - std::round(winding)) <= whole))
    winding = face_by_face(0, faces_.size(), point) / sphere;
  return std::abs(winding) > 0.5;
}

}  // namespace sphparam
