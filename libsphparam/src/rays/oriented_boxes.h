#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A tree over triangles whose boxes lie as the triangles do: along the needles of a brush, of a
/// tube that winds, wherever they point. Boxes along the axes of such meshes overlap by the
/// hundred. Source: Gottschalk, Lin and Manocha, "OBBTree" (1996).
class OrientedBoxes {
 public:
  /// Requires: finite positions, whose squares are numbers once they are scaled; a face. The mesh
  /// outlives the tree. Cost: O(n log n), about 2 µs and 110 bytes a face.
  OrientedBoxes(const TriangleMesh& mesh, std::vector<Face> faces, double scale);

  /// Calls consider(face) for faces, near ones first, whose box is no farther than within() says,
  /// squared; until consider says that this is enough.
  template <class Within, class Consider>
  void visit(const Vector3& point, const Within& within, const Consider& consider) const;

 private:
  struct Box {
    Eigen::Matrix3d axes;          // rows
    Vector3 origin, lower, upper;  // the corners as seen from the origin, along the axes
    int second = 0;                // its other half's box, if it has one; the first follows it
    int begin = 0, count = 0;      // of its faces
    double squared_distance(const Vector3& point) const {
      const Vector3 local = axes * (point - origin);
      return (lower - local).cwiseMax(local - upper).cwiseMax(0).squaredNorm();
    }
  };
  struct Waiting {
    int box;
    double squared;
  };
  static constexpr size_t most_waiting = 64;  // halves are equal: no tree is as deep

  const Vector3& middle(Face face) const { return middles_[static_cast<size_t>(face)]; }
  void build(int begin, int end);
  Box box_about(std::span<const Face> faces) const;
  int best_axis(std::span<const Face> faces, const Box& box) const;

  const TriangleMesh& mesh_;
  const double scale_;
  std::vector<Face> faces_;
  std::vector<Vector3> middles_;  // by face, while the tree is built
  std::vector<Box> boxes_;
};

template <class Within, class Consider>
void OrientedBoxes::visit(const Vector3& point, const Within& within,
                          const Consider& consider) const {
  std::array<Waiting, most_waiting> waiting;
  size_t count = 0;
  const auto wait = [&](int box) {
    waiting[count++] = {box, boxes_[static_cast<size_t>(box)].squared_distance(point)};
  };
  wait(0);
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.squared > within()) continue;
    const Box& box = boxes_[static_cast<size_t>(next.box)];
    if (box.second == 0) {
      for (int i = box.begin; i < box.begin + box.count; ++i) {
        if (consider(faces_[static_cast<size_t>(i)])) return;
      }
      continue;
    }
    wait(next.box + 1);
    wait(box.second);
    if (waiting[count - 1].squared > waiting[count - 2].squared)
      std::swap(waiting[count - 1], waiting[count - 2]);
  }
}

}  // namespace sphparam
