#include <catch2/catch.hpp>
#include <utility>

#include "sphparam/gltf/export.h"
#include "support/place.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

const ExportOptions small{.look = {.image_width = 64}};

MappedMesh ball(const std::string& name) {
  MeshFile file;
  file.mesh = icosphere(1);
  const SphereMap map{file.mesh.positions};
  return MappedMesh({.file = std::move(file), .map = map, .name = name});
}

}  // namespace

TEST_CASE("asset files: an asset is called as its mesh, without folders and endings") {
  for (const auto& [name, called] : {std::pair("scans/egg.v2.obj", "egg.v2"),
                                     {"egg.sph.ply", "egg"},
                                     {"egg.ply.gz", "egg"},
                                     {"mesh", "mesh"}})
    CHECK(make_asset(ball(name), small).name == called);
}

TEST_CASE("asset files: a textured mesh without an image is refused") {
  const Place place;
  PendingFiles files;
  for (const char* name : {"a.obj", "a.ply"}) {
    CHECK_THROWS_AS(textured_files(place / name, {}), std::invalid_argument);
    CHECK_THROWS_AS(add_textured_mesh(files, place / name, ball("ball.obj"), {}, small),
                    std::invalid_argument);
  }
}

}  // namespace sphparam::tests
