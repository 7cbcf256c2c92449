#pragma once

#include <memory>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"

namespace sphparam {

/// The normal that the source is lit with: that of its corners or vertices, linear between them;
/// where a material has a normal map, what that says in the frame that the file says, else in that
/// of the source's own texture coordinates (`source_tangents`).
class SourceNormal {
 public:
  /// Reads the normal maps. `scene` outlives it. Throws: ImageError for one that cannot be read;
  /// FieldError for one without texture coordinates.
  explicit SourceNormal(const BakeScene& scene);

  /// Unit. Of a sample its point, step and below are looked at.
  Vector3 at(const SurfaceSample& sample) const;

 private:
  struct Maps;
  Vector3 mapped(const SurfaceSample& sample) const;

  const BakeScene* scene_;
  std::shared_ptr<const Maps> maps_;  // none: no material has one
};

}  // namespace sphparam
