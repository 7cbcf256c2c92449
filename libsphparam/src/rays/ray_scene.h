#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "sphparam/mesh/surface_point.h"

namespace sphparam {

struct Ray {
  Vector3 origin, unit_direction;
  double reach;  // less than 0: it meets nothing
};

/// What a ray meets first.
struct RayHit {
  Face face = -1;  // none
  double distance = 0;
};

/// The point of a mesh that is nearest to another.
struct NearestPoint {
  SurfacePoint on;
  double squared_distance = 0;
};

/// A mesh to cast rays into and to find nearest points on: any triangles, closed or not. Both sides
/// of a triangle count. Everything may be called from many threads at once.
///
/// Rays are cast in single precision, in coordinates that fill the cube [−1, 1]³ wherever the mesh
/// lies; they find no way between triangles that share an edge. Nearest points are exact to the
/// double. The same answers for any number of threads.
class RayScene {
 public:
  /// Requires: finite positions; at least one triangle; indices in range; the mesh outlives the
  /// scene. Throws: std::invalid_argument; std::bad_alloc.
  /// Cost: O(#F log #F), about 0.5 µs and 150 bytes a triangle, one thread.
  explicit RayScene(const TriangleMesh& mesh);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// The least distance from a surface at which a ray must start not to meet it by rounding: 2⁻²⁰
  /// of the longest side of the bounding box at most, eight times the rounding of both.
  double clearance() const;
  /// Of the bounding box of what triangles use.
  double diagonal() const;

  /// Whether each of some rays from one origin meets something within `reach`.
  /// Requires: unit directions; blocked.size() == directions.size().
  void find_blocked(const Vector3& origin, std::span<const Eigen::Vector3f> directions,
                    double reach, std::span<std::uint8_t> blocked) const;

  /// How far each of some rays from one origin goes, `reach` at most.
  void find_distances(const Vector3& origin, std::span<const Eigen::Vector3f> directions,
                      double reach, std::span<float> distances) const;

  RayHit first_hit(const Vector3& origin, const Vector3& unit_direction, double reach) const;

  /// The same of many rays, eight at a time: some times as fast where those side by side start near
  /// one another and go about the same way. Where one meets an edge, the face may be the other one
  /// of it than alone. Requires: hits.size() == rays.size().
  void first_hits(std::span<const Ray> rays, std::span<RayHit> hits) const;

  /// The nearest point, by `nearest_on_triangle`; of triangles equally near, the first. Farther
  /// away than 10⁹ times the mesh's size, any of those that no double can tell apart. `guess`: a
  /// face that may be near, which saves time and changes nothing. `near_enough`: the search ends
  /// with the first point found whose squared distance is no larger, which need not be the nearest.
  /// Requires: no coordinate of the mesh or the point beyond 1e150, and a mesh that is no smaller
  /// than 1e-150. Cost: O(log #F) where the surface is not equally far everywhere.
  NearestPoint nearest(const Vector3& point, Face guess = -1, double near_enough = -1) const;

  /// Whether some point of the mesh is within `distance` of the point. Much cheaper than `nearest`
  /// where there is none, or many. `guess` and requires: as `nearest`.
  bool is_within(double distance, const Vector3& point, Face guess = -1) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace sphparam
