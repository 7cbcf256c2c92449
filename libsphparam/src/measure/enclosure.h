#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Edges at which a surface does not close: open ones, and those whose faces, of which there may be
/// more than two, do not run along them as often one way as the other. Cost: O(#F log #F).
std::int64_t unclosed_edges(const Triangles& triangles);

/// What a closed surface encloses: the points about which it winds, one way or the other, so that
/// parts may overlap, faces be flat, and all of it be inside out.
///
/// The winding number is the sum of the faces' solid angles over 4π. Faces far away are taken
/// together, as a dipole (Barill, Dickson, Schmidt, Levin and Jacobson, "Fast winding numbers for
/// soups and clouds", 2018). A sum that is no whole number, as the exact one is, is taken again,
/// face by face.
class Enclosure {
 public:
  /// Requires: no unclosed edge; finite positions between 1e-60 and 1e60; the mesh outlives this.
  /// Cost: O(#F log #F), about 60 bytes a triangle.
  explicit Enclosure(const TriangleMesh& mesh);

  /// Of a point that is not on the surface. Cost: O(log #F) in general, a few microseconds.
  bool holds(const Vector3& point) const;

 private:
  struct Cluster {
    Vector3 middle, area;  // of its faces: mean by area; ½ Σ (b − a) × (c − a)
    double radius;         // about the middle
    std::size_t first, last;
    std::size_t second_half;  // its first half comes next; 0: it is not cut
  };

  void add_cluster(std::size_t first, std::size_t last);
  double far_or_near(std::size_t index, const Vector3& point) const;
  double face_by_face(std::size_t first, std::size_t last, const Vector3& point) const;

  const TriangleMesh& mesh_;
  std::vector<Face> faces_;  // those of a cluster side by side
  std::vector<Cluster> clusters_;
};

}  // namespace sphparam
