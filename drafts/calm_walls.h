#pragma once

#include <memory>
#include <span>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"
#include "bake/texel_owners.h"

namespace sphparam {

/// What a field shows on the walls of a target (`BakeTarget::walls`), where the surface that is
/// baked on it is far and the nearest points make streaks: the values around each wall, carried
/// across it as smoothly as can be. Tangent normals are flat there, object normals the target's.
///
/// Ensures: the same values for any number of threads. Source: our own; each wall is a discrete
/// harmonic function of its rim, with a weight of one an edge.
class CalmWalls {
 public:
  /// Nothing for fields that stay as they are found: labels, places, and what is no appearance.
  /// `evaluate_at`: the values of the field at points of the source, colours linear.
  /// Cost: one look at the surface a triangle beside a wall, and a sparse Cholesky factor.
  static std::shared_ptr<const CalmWalls> make(const SurfaceField& field, const BakeScene& scene);

  /// Puts them in place of what was found at texels on walls.
  void fill(std::span<const TexelRun> places, int channels, float* values) const;

 private:
  Triangles triangles_;  // of the chart
  FillerMarks walls_;    // a triangle
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values_;  // a vertex
};

/// The triangles of a target all of whose corners are farther than `beyond` from the surface that is
/// baked on it, where others about them are nearer. Empty: none.
FillerMarks walls_of(const BakeTarget& target, const ProjectedSurface& surface, double beyond,
                     int threads);

}  // namespace sphparam
