#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bake/bake_rows.h"
#include "bake/make_scene.h"
#include "sphparam/parameterize.h"

/// Scenes and images of bakes, for tests.
namespace sphparam::tests {

inline std::unique_ptr<sphparam::BakeScene> scene_of(sphparam::MeshFile file, const SphereMap& map,
                                                     sphparam::FieldOptions options = {}) {
  const MappedMesh mapped({.file = std::move(file), .map = map}, 1);
  const Points normals = mapped.mesh().positions.rowwise().normalized();
  return std::unique_ptr<sphparam::BakeScene>(
      new sphparam::BakeScene{{mapped, normals, {}}, make_target(mapped, true, 1), options, 1});
}

/// A mesh on the sphere as its own map.
inline std::unique_ptr<sphparam::BakeScene> sphere_scene(const TriangleMesh& mesh) {
  sphparam::MeshFile file;
  file.mesh = mesh;
  return scene_of(std::move(file), normalised(mesh.positions));
}

/// All values of one field.
inline std::vector<float> baked(const sphparam::BakeScene& scene,
                                const sphparam::SurfaceField& field,
                                const sphparam::BakeOptions& options) {
  std::vector<float> values;
  const std::vector<sphparam::SurfaceField> fields = {field};
  sphparam::bake(scene, fields, options, [&](size_t, int first_row, int rows, const float* row) {
    const size_t width = static_cast<size_t>(options.width * field.channels);
    if (values.size() != static_cast<size_t>(first_row) * width) throw 0;
    values.insert(values.end(), row, row + static_cast<size_t>(rows) * width);
  });
  return values;
}

}  // namespace sphparam::tests
