// A box's axes are the principal axes of the sides of its triangles, each weighted by its squared
// length: along the needles of a bundle, across a flat piece. It is halved at the median of its
// triangles' middles, along the axis that leaves halves of the least surface.

#include "rays/oriented_boxes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

namespace sphparam {

namespace {

constexpr int most_in_leaf = 4;

double half_surface(const Vector3& size) {
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

}  // namespace

OrientedBoxes::OrientedBoxes(const TriangleMesh& mesh, std::vector<Face> faces, double scale)
    : mesh_(mesh),
      scale_(scale),
      faces_(std::move(faces)),
      middles_(static_cast<size_t>(mesh.face_count())) {
  for (const Face f : faces_) {
    const auto corners = mesh.triangles.row(f);
    middles_[static_cast<size_t>(f)] = mesh.position(corners[0]) / 3 +
                                       mesh.position(corners[1]) / 3 +
                                       mesh.position(corners[2]) / 3;
  }
  build(0, static_cast<int>(faces_.size()));
  middles_ = {};
}

OrientedBoxes::Box OrientedBoxes::box_about(std::span<const Face> faces) const {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Face f : faces) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 side =
          mesh_.position(mesh_.triangles(f, (k + 1) % 3)) - mesh_.position(mesh_.triangles(f, k));
      squares += (scale_ * side) * (scale_ * side).transpose();
    }
  }
  Box box;
  box.axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors().transpose();
  box.origin = middle(faces.front());
  box.lower = box.upper = Vector3::Zero();
  for (const Face f : faces) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 corner = box.axes * (mesh_.position(mesh_.triangles(f, k)) - box.origin);
      box.lower = box.lower.cwiseMin(corner);
      box.upper = box.upper.cwiseMax(corner);
    }
  }
  return box;
}

/// Of halves on both sides of the mean of the middles.
int OrientedBoxes::best_axis(std::span<const Face> faces, const Box& box) const {
  Vector3 mean = Vector3::Zero();
  for (const Face f : faces) mean += middle(f) / static_cast<double>(faces.size());
  Eigen::AlignedBox3d halves[3][2];
  for (const Face f : faces) {
    Eigen::AlignedBox3d own;
    for (int k = 0; k < 3; ++k)
      own.extend((box.axes * (mesh_.position(mesh_.triangles(f, k)) - mean)).eval());
    const Vector3 side = box.axes * (middle(f) - mean);
    for (int axis = 0; axis < 3; ++axis) halves[axis][side[axis] > 0].extend(own);
  }
  Vector3 surfaces;
  for (int axis = 0; axis < 3; ++axis)
    surfaces[axis] = half_surface(halves[axis][0].sizes()) + half_surface(halves[axis][1].sizes());
  int best = 0;
  surfaces.minCoeff(&best);
  return best;
}

void OrientedBoxes::build(int begin, int end) {
  const auto first = faces_.begin() + begin, last = faces_.begin() + end;
  const size_t at = boxes_.size();
  boxes_.push_back(box_about({first, last}));
  boxes_[at].begin = begin;
  boxes_[at].count = end - begin;
  if (end - begin <= most_in_leaf) return;
  const Vector3 along = boxes_[at].axes.row(best_axis({first, last}, boxes_[at]));
  const int half = begin + (end - begin) / 2;
  std::nth_element(first, faces_.begin() + half, last, [&](Face a, Face b) {
    const double x = along.dot(middle(a)), y = along.dot(middle(b));
    return x != y ? x < y : a < b;
  });
  build(begin, half);
  boxes_[at].second = static_cast<int>(boxes_.size());
  build(half, end);
}

}  // namespace sphparam
