#pragma once

#include <memory>
#include <optional>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"
#include "rays/ray_scene.h"

namespace sphparam {

/// A place, the way one looks there, and what a texel covers.
struct Sight {
  Vector3 from, way, step, below;
};

/// What one sees through places of a surface that is blended: straight behind them, what a viewer
/// draws there, which is fronts, and backs of materials with two sides. Faces that only close holes
/// are no surface. Threads may share it.
class WhatIsBehind {
 public:
  /// The scene outlives it. Cost: a `RayScene` where the source is not `surface`, which has one.
  explicit WhatIsBehind(const BakeScene& scene);

  /// Of the i-th sample of a run, looked at from the side that it shows.
  Sight through(const SurfaceRun& run, int i) const;

  /// The next place behind, from which `sight` goes on then; none: nothing is drawn there.
  std::optional<SurfaceRun> next(Sight& sight) const;

 private:
  Eigen::Matrix3d corners(Face f) const;
  bool is_drawn(Face f, const Vector3& way) const;

  const MeshFile* file_;
  TriangleMesh surface_;  // of a source with a map, without fillers
  std::unique_ptr<const RayScene> own_;
  const RayScene* rays_;
};

}  // namespace sphparam
