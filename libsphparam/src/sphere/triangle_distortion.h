#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// A row of a `Distortion`: of one triangle.
struct DistortionRow {
  std::array<double, 3> angle_ratio;
  double area_ratio, sigma_max, sigma_min, source_area;
};

/// Measures how a map distorts the triangles of a mesh, some at a time. The mesh and the map
/// outlive it. Ensures: the same bits however the triangles are shared out, and for any number of
/// threads.
class TriangleMeter {
 public:
  /// Requires: triangles, one or more; a ray a vertex. Cost: two passes, for the total area.
  TriangleMeter(const TriangleMesh& mesh, const SphereMap& map, int threads);

  static constexpr size_t most = 64;  // triangles at once

  /// Triangles first, first + 1, …. Requires: at most `most`.
  void measure(Eigen::Index first, std::span<DistortionRow> rows) const;

 private:
  const TriangleMesh& mesh_;
  const SphereMap& map_;
  double scale_;  // makes the mesh about unit size
  double least_doubled_area_ = 0, to_sphere_ = 1;
};

}  // namespace sphparam
