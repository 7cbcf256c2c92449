#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"
#include "rays/ray_scene.h"
#include "sphparam/bake/bake.h"

namespace sphparam {

/// A place on the target whose point of the other surface is wanted, and what a texel covers there.
struct PlaceOnTarget {
  Face face;                // of its chart
  Vector3 at, step, below;  // weights of the corners, and what they change by a texel east, south
};

/// A surface that lies about where the target does, closed or not, in any number of parts, and
/// which of its points a point of the target shows.
///
/// That is what a line along the target's smooth normal (of faces weighted by angle: by area,
/// bevels along edges would show stripes) meets, outwards or inwards: of what faces the same way
/// the nearer; else of what faces the other way. It counts while it is no more than four times as
/// far as the nearest point of the surface, as it is where that is flat and tilted by 75°; beyond,
/// the line passes the surface by, and the nearest point is taken. So there is no cage to draw and
/// no distance to choose. Faces that only close holes are no surface. Source: our own.
class ProjectedSurface {
 public:
  /// Throws: FieldError for a file without triangles.
  explicit ProjectedSurface(MeshFile file);

  const MeshFile& file() const { return file_; }
  const RayScene& rays() const { return *rays_; }

  /// Appends the points, each as a run of one texel. Weights may lie outside the face, in its
  /// plane; what a texel covers is taken along the normal as if that did not turn. Requires: a
  /// target that has `outward`. `guess`: a face of the surface that may be near, which saves time
  /// and changes nothing. Cost: two rays and a look about each, a µs or two; less for places side
  /// by side, whose rays go together. Threads may share it.
  void project(const BakeTarget& target, std::span<const PlaceOnTarget> places, Face guess,
               std::vector<SurfaceRun>& runs) const;

  /// Of one place.
  SurfaceRun project(const BakeTarget& target, const PlaceOnTarget& place, Face guess = -1) const {
    std::vector<SurfaceRun> runs;
    project(target, std::span(&place, 1), guess, runs);
    return runs.front();
  }

 private:
  void project_some(const BakeTarget& target, std::span<const PlaceOnTarget> places, Face guess,
                    std::vector<SurfaceRun>& runs) const;

  MeshFile file_;
  TriangleMesh surface_;  // without fillers; faces keep their numbers
  std::unique_ptr<const RayScene> rays_;
};

/// How the target finds the surface, by shares of the target's area, and how far away.
/// Cost: one `project` a triangle of the target.
ProjectionShares measure_projection(const ProjectedSurface& surface, const BakeTarget& target,
                                    int threads);

}  // namespace sphparam
