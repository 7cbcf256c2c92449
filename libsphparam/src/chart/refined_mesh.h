#pragma once

#include <span>
#include <vector>

#include "chart/halfedge_links.h"
#include "sphparam/mesh/surface_point.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// A closed triangle mesh on the sphere that can be split, and that knows where its vertices lie in
/// the mesh it came from. Splitting keeps everything else in place.
class RefinedMesh : public HalfedgeLinks {
 public:
  RefinedMesh(const Topology& topology, const SphereMap& map, const Triangles& source, int threads);

  int vertex_count() const { return static_cast<int>(points_.size()); }
  int face_count() const { return static_cast<int>(source_faces_.size()); }
  Vertex vertex(Face f, int corner) const { return origin(3 * f + corner); }
  const Vector3& point(Vertex v) const { return points_[static_cast<size_t>(v)]; }
  std::span<const Vector3> rays() const { return points_; }
  Points points() const;
  Triangles triangles() const;
  const std::vector<SurfacePoint>& surface_points() const { return surface_points_; }
  const std::vector<Face>& source_faces() const { return source_faces_; }

  /// Moves a vertex by rounding: where it lies in the source stays as it is.
  void snap(Vertex v, const Vector3& point) { points_[static_cast<size_t>(v)] = point; }

  /// Are the four faces positive that splitting the edge of h at that ray would make? Exact.
  bool fits(Halfedge h, const Vector3& ray) const;

  /// Puts a vertex on an edge (from a to b, at (1 − t)·a + t·b) and joins it to both apexes. The
  /// faces of h and its twin become those at a and b; two new ones follow.
  /// Requires: `point` is that of the edge up to rounding.
  Vertex split_edge(Halfedge h, double t, const Vector3& point);

  /// Puts a vertex into a face, at Σ weightsᵢ·(point of corner i), and joins it to the corners. The
  /// face keeps its first edge; two new ones follow.
  Vertex split_face(Face f, const Vector3& weights, const Vector3& point);

 private:
  Vertex add_vertex(Face f, const Vector3& corner_weights, const Vector3& point);
  Halfedge add_face(Vertex a, Vertex b, Vertex c, Face source);

  const Triangles& source_;
  std::vector<Face> source_faces_;
  std::vector<Vector3> points_;
  std::vector<SurfacePoint> surface_points_;
  std::vector<double> lengths_;  // |Σ λᵢ xᵢ| before it was made unit; 1 for the source's vertices
};

}  // namespace sphparam
