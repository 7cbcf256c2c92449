#pragma once

#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/mesh/surface_point.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam {

/// A map from one surface to another, through the sphere: to the direction that the first one's map
/// has there, and from it to the point that the second one's map has there.
///
/// Both maps are proved one-to-one onto the sphere, so what they make together is proved to be
/// one-to-one. A value that never changes; copies cost nothing. Our own use of Praun and Hoppe,
/// "Spherical parametrization and remeshing" (2003), Section 5.
class SurfaceMap {
 public:
  SurfaceMap(MappedMesh from, MappedMesh to) : from_(std::move(from)), to_(std::move(to)) {}

  const MappedMesh& from() const { return from_; }
  const MappedMesh& to() const { return to_; }
  SurfaceMap inverse() const { return {to_, from_}; }

  /// For every vertex of `from`: its point on `to`, whose face holds it by exact signs. Same for
  /// any number of threads. Cost: 0.1 µs a vertex.
  std::vector<SurfacePoint> forth(int threads = 0) const;
  /// For every vertex of `to`: its point on `from`.
  std::vector<SurfacePoint> back(int threads = 0) const { return inverse().forth(threads); }

  /// The triangles of `from` with their vertices on `to`: its connectivity in the other's shape.
  TriangleMesh from_on_to(int threads = 0) const;

 private:
  MappedMesh from_, to_;
};

/// A point of a mesh in space. Requires: a face of it.
Vector3 position(const TriangleMesh& mesh, const SurfacePoint& point);

/// Values a vertex of a mesh at points of it, linear in each triangle. Requires: faces of it.
std::vector<double> values_at(const TriangleMesh& mesh, const std::vector<double>& values,
                              const std::vector<SurfacePoint>& points);

/// How the map distorts each triangle of `from`, whose image is taken to be the flat triangle of
/// its corners' points on `to`. As `measure_distortion` has it: both surfaces are scaled to the
/// same area; the areas are of flat triangles, without a sign. Fillers are no surface: they do not
/// count in the areas, and have the share 0, with which they are in no figure.
/// Throws: UnmeasurableMesh where one has no area.
Distortion measure_distortion(const SurfaceMap& map, int threads = 0);

/// Its figures; fillers are not among the triangles that have no area.
DistortionSummary summarise_distortion(const SurfaceMap& map, int threads = 0);

}  // namespace sphparam
