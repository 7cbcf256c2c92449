#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "program.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

/// A mapped mesh in a folder of its own.
struct Mapped {
  Folder folder;
  std::string path = folder / "shape.sph.ply";

  explicit Mapped(int vertices = 400) {
    const Ended ended =
        sphparam_program({"map", "-", "-o", path}, obj_text(random_sphere_mesh(vertices, 8)));
    REQUIRE(ended.code == 0);
  }

  Ended remesh(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"remesh", path});
    return sphparam_program(arguments);
  }
};

}  // namespace sphparam::tests
