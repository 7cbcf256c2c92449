#include <catch2/catch.hpp>

#include "sphparam/gltf/export.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

TEST_CASE("facing: an asset of a mesh that is inside out says so, one of its sphere does not") {
  MeshFile file;
  file.mesh = icosphere(2);
  SphereMap map{-file.mesh.positions};
  file.mesh.triangles.col(1).swap(file.mesh.triangles.col(2));
  const MappedMesh inverted({.file = std::move(file), .map = std::move(map), .name = "egg"});
  ExportOptions options{.look = {.image_width = 64}};
  CHECK(make_asset(inverted, options).warnings ==
        std::vector<std::string>{
            "the mesh is inside out: viewers show the inside of its far side, or light it from "
            "behind; --repair=orientation turns it over"});
  options.shape = ShapeKind::Sphere;
  CHECK(make_asset(inverted, options).warnings.empty());
}

}  // namespace sphparam::tests
