#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bake/bake.h"
#include "bake/make_scene.h"
#include "sphparam/parameterize.h"

/// Scenes and images of bakes, for tests.
namespace sphparam::tests {

inline std::unique_ptr<tools::BakeScene> scene_of(tools::MeshFile file, const SphereMap& map,
                                                  tools::MapOptions options = {}) {
  Topology topology(file.mesh);
  tools::BakeTarget target = tools::make_target(file, topology, map, true, 1);
  const Points normals = file.mesh.positions.rowwise().normalized();
  return std::unique_ptr<tools::BakeScene>(new tools::BakeScene{
      {std::move(file), map, std::move(topology), normals, {}}, std::move(target), options, 1});
}

/// A mesh on the sphere as its own map.
inline std::unique_ptr<tools::BakeScene> sphere_scene(const TriangleMesh& mesh) {
  tools::MeshFile file;
  file.mesh = mesh;
  return scene_of(std::move(file), normalised(mesh.positions));
}

/// All values of one field.
inline std::vector<float> baked(const tools::BakeScene& scene, const tools::SurfaceField& field,
                                const tools::BakeOptions& options) {
  std::vector<float> values;
  const std::vector<tools::SurfaceField> fields = {field};
  tools::bake(scene, fields, options, [&](size_t, int first_row, int rows, const float* row) {
    const size_t width = static_cast<size_t>(options.width * field.channels);
    if (values.size() != static_cast<size_t>(first_row) * width) throw 0;
    values.insert(values.end(), row, row + static_cast<size_t>(rows) * width);
  });
  return values;
}

}  // namespace sphparam::tests
