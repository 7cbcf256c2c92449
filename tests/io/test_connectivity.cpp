#include <catch2/catch.hpp>

#include "reading.h"
#include "sphparam/io/connectivity.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::connectivity_difference;
using sphparam::cut_otherwise;
using sphparam::MeshFile;

namespace {

/// A quad bent along 0–2 or along 1–3, and a triangle: reading cuts it along the other diagonal.
MeshFile bent(bool along_first, const std::string& faces = "f 1 2 3 4\nf 4 3 5\n") {
  return read(std::string(along_first ? "v 0 0 0\nv 1 0 0\nv 3 3 0\nv 0 1 0\n"
                                      : "v 0 0 0\nv 3 -3 0\nv 1 1 0\nv -3 3 0\n") +
                  "v 9 9 1\n" + faces,
              "a.obj");
}

}  // namespace

TEST_CASE("connectivity: a quad that two files cut each by its own places is one quad") {
  const MeshFile shape = bent(true), sphere = bent(false);
  REQUIRE(shape.mesh.triangles != sphere.mesh.triangles);
  CHECK(connectivity_difference(shape, sphere).empty());
  CHECK(cut_otherwise(shape, sphere) == 1);
  CHECK(connectivity_difference(shape, shape).empty());
  CHECK(cut_otherwise(shape, shape) == 0);
}

TEST_CASE("connectivity: triangles that a file itself has are not cut anew") {
  const MeshFile shape = bent(true);
  MeshFile sphere = bent(false);
  sphere.polygons = 0;  // as where the file held these triangles
  CHECK(contains(connectivity_difference(shape, sphere), "triangle 0"));
  CHECK(connectivity_difference(sphere, shape).empty());  // here the second one's cut is ours
}

TEST_CASE("connectivity: other polygons are another connectivity") {
  const MeshFile shape = bent(true);
  CHECK_FALSE(connectivity_difference(shape, bent(false, "f 1 4 3 2\nf 4 3 5\n")).empty());
  CHECK_FALSE(connectivity_difference(shape, bent(false, "f 1 2 3 4\nf 3 4 5\n")).empty());
  CHECK_FALSE(connectivity_difference(shape, bent(false, "f 4 3 5\nf 1 2 3 4\n")).empty());
  CHECK(contains(connectivity_difference(shape, bent(false, "f 1 2 3 4\n")), "2 triangles") ==
        false);
  CHECK(contains(connectivity_difference(shape, bent(false, "f 1 2 3 4\n")), "3 triangles"));
}
