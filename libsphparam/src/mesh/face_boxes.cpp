#include "mesh/face_boxes.h"

#include <algorithm>
#include <utility>

// Halves of equally many faces, along the longest side of the box about their middles.

namespace sphparam {
namespace {

Box box_of_face(const TriangleMesh& mesh, Face f) {
  Box box;
  for (int k = 0; k < 3; ++k) box.add(mesh.position(mesh.triangles(f, k)));
  return box;
}

}  // namespace

FaceBoxes::FaceBoxes(const TriangleMesh& mesh, std::vector<Face> faces) : faces_(std::move(faces)) {
  std::vector<Sorted> sorted;
  sorted.reserve(faces_.size());
  for (const Face f : faces_) sorted.push_back({box_of_face(mesh, f), f});
  if (!sorted.empty()) build(sorted, 0, static_cast<int>(sorted.size()));
  boxes_.reserve(sorted.size());
  for (size_t i = 0; i < sorted.size(); ++i) {
    faces_[i] = sorted[i].face;
    boxes_.push_back(sorted[i].box);
  }
}

void FaceBoxes::build(std::vector<Sorted>& sorted, int begin, int end) {
  const size_t node = nodes_.size();
  nodes_.push_back({.begin = begin, .end = end});
  Box box, middles;
  for (int i = begin; i < end; ++i) {
    box.add(sorted[at(i)].box.lower);
    box.add(sorted[at(i)].box.upper);
    middles.add({sorted[at(i)].middle(0), sorted[at(i)].middle(1), sorted[at(i)].middle(2)});
  }
  nodes_[node].box = box;
  if (end - begin <= most_in_leaf) {
    leaves_.push_back(static_cast<int>(node));
    return;
  }
  Eigen::Index axis = 0;
  (middles.upper - middles.lower).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(sorted.begin() + begin, sorted.begin() + middle, sorted.begin() + end,
                   [axis](const Sorted& a, const Sorted& b) {
                     return std::pair(a.middle(axis), a.face) < std::pair(b.middle(axis), b.face);
                   });
  build(sorted, begin, middle);
  nodes_[node].second = static_cast<int>(nodes_.size());
  build(sorted, middle, end);
}

}  // namespace sphparam
