#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"

/// `sphparam remesh` and `sphparam unimage`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

/// A mapped mesh in a folder of its own.
struct Mapped {
  Folder folder;
  std::string path = folder / "shape.sph.ply";
  Mapped() {
    const Ended ended =
        sphparam_program({"map", "-", "-o", path}, obj_text(random_sphere_mesh(400, 8)));
    REQUIRE(ended.code == 0);
  }
  Ended remesh(Names arguments) const {
    arguments.insert(arguments.begin(), {"remesh", path});
    return sphparam_program(arguments);
  }
};

}  // namespace

TEST_CASE("remesh: every grid is written certified, and reported") {
  const Mapped mapped;
  for (const std::string& grid : Names{"ico:3", "ico:f=5", "octa:17", "cube:6", "uv:16x9",
                                       "healpix:4", "like:" + mapped.path}) {
    INFO(grid);
    const std::string out = mapped.folder / "new.sph.ply", json = mapped.folder / "new.json";
    const Ended ended = mapped.remesh({"--grid", grid, "-o", out, "--json", json});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(sphparam_program({"verify", out}).code == 0);
    CHECK(Json::parse(bytes_of(json))["grid"]["name"] == grid);
  }
}

TEST_CASE("remesh: the same bytes for one thread and three") {
  const Mapped mapped;
  for (const char* threads : {"1", "3"}) {
    CHECK(mapped
              .remesh({"--grid", "octa:33", "-o", mapped.folder / (std::string(threads) + ".ply"),
                       "--threads", threads})
              .code == 0);
  }
  CHECK(bytes_of(mapped.folder / "1.ply") == bytes_of(mapped.folder / "3.ply"));
}

TEST_CASE("remesh: a geometry image turns back into the mesh in float32") {
  const Mapped mapped;
  for (const std::string& grid : Names{"octa:33", "cube:8"}) {
    INFO(grid);
    const std::string mesh = mapped.folder / "mesh.sph.ply", image = mapped.folder / "image.exr",
                      back = mapped.folder / "back.sph.ply";
    REQUIRE(mapped.remesh({"--grid", grid, "-o", mesh, "--geometry-image", image}).code == 0);
    const Ended ended = sphparam_program({"unimage", image, "-o", back});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(sphparam_program({"verify", back}).code == 0);
  }
}

TEST_CASE("remesh: what makes no sense is refused, and nothing is written") {
  const Mapped mapped;
  const std::string out = mapped.folder / "new.ply";
  CHECK(mapped.remesh({"--grid", "octa:8", "-o", out}).code == 2);
  CHECK(mapped.remesh({"--grid", "ico:3"}).code == 2);
  CHECK(mapped.remesh({"--grid", "ico:3", "-o", mapped.path}).code == 2);
  CHECK(mapped.remesh({"--grid", "ico:3", "-o", out, "--transfer", "thicknes"}).code == 2);
  CHECK(mapped.remesh({"--grid", "ico:3", "--geometry-image", mapped.folder / "gi.exr"}).code == 2);
  CHECK(mapped.remesh({"--grid", "like:" + (mapped.folder / "none.ply"), "-o", out}).code == 3);
  CHECK(sphparam_program({"unimage", mapped.path, "-o", out}).code == 3);
  CHECK(sphparam_program({"verify", out}).code == 3);
}

}  // namespace sphparam::tests
