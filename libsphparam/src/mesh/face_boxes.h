#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/box.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A tree of upright boxes about faces, a few in each of its leaves, for pairs of faces that are
/// near one another, and for those above a point.
class FaceBoxes {
 public:
  static constexpr int most_in_leaf = 8;  // faces

  /// Requires: faces that name vertices that are there, with finite positions. Cost: O(n log n),
  /// about 0.2 µs and 80 bytes a face.
  FaceBoxes(const TriangleMesh& mesh, std::vector<Face> faces);

  std::int64_t leaf_count() const { return static_cast<std::int64_t>(leaves_.size()); }

  /// Calls visit(f, g) for the pairs of faces whose boxes have a point in common, one of this leaf
  /// and the other of it or of a later one: all leaves come to each pair once. Returns how many
  /// pairs were looked at; it ends after `most`, or little more.
  template <class Visit>
  std::int64_t visit_pairs(std::int64_t leaf, std::int64_t most, const Visit& visit) const;

  /// Calls visit(f) for the faces whose boxes meet the ray from a point along +z.
  template <class Visit>
  void visit_above(const Vector3& point, const Visit& visit) const;

 private:
  struct Node {
    Box box;
    int second = 0;          // its other half, if it has one; the first follows it
    int begin = 0, end = 0;  // of its faces
  };

  struct Sorted {
    Box box;
    Face face;
    double middle(Eigen::Index axis) const { return box.lower[axis] / 2 + box.upper[axis] / 2; }
  };

  static size_t at(int i) { return static_cast<size_t>(i); }
  static bool overlap(const Box& a, const Box& b) {
    return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
  }
  static bool is_above(const Box& box, const Vector3& point) {
    return (box.lower.head<2>().array() <= point.head<2>().array()).all() &&
           (point.array() <= box.upper.array()).all();
  }
  void build(std::vector<Sorted>& sorted, int begin, int end);

  std::vector<Face> faces_;
  std::vector<Box> boxes_;   // of the faces, in their order
  std::vector<Node> nodes_;  // in the order of their faces
  std::vector<int> leaves_;  // nodes, likewise
};

template <class Visit>
std::int64_t FaceBoxes::visit_pairs(std::int64_t leaf, std::int64_t most,
                                    const Visit& visit) const {
  const Node& own = nodes_[static_cast<size_t>(leaves_[static_cast<size_t>(leaf)])];
  std::int64_t looks = 0;
  std::array<int, 64> waiting;  // halves are equal: no tree is as deep
  size_t count = 0;
  waiting[count++] = 0;
  while (count > 0 && looks < most) {
    const int i = waiting[--count];
    const Node& node = nodes_[at(i)];
    if (node.end <= own.begin || !overlap(node.box, own.box)) continue;
    if (node.second > 0) {
      waiting[count++] = node.second;
      waiting[count++] = i + 1;
      continue;
    }
    for (int f = own.begin; f < own.end; ++f) {
      for (int g = std::max(f + 1, node.begin); g < node.end; ++g, ++looks) {
        if (overlap(boxes_[at(f)], boxes_[at(g)])) visit(faces_[at(f)], faces_[at(g)]);
      }
    }
  }
  return looks;
}

template <class Visit>
void FaceBoxes::visit_above(const Vector3& point, const Visit& visit) const {
  std::vector<int> waiting;
  if (!nodes_.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const int i = waiting.back();
    const Node& node = nodes_[at(i)];
    waiting.pop_back();
    if (!is_above(node.box, point)) continue;
    if (node.second > 0) {
      waiting.insert(waiting.end(), {node.second, i + 1});
      continue;
    }
    for (int f = node.begin; f < node.end; ++f)
      if (is_above(boxes_[at(f)], point)) visit(faces_[at(f)]);
  }
}

}  // namespace sphparam
