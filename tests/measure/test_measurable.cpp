#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "sphparam/measure/measurable.h"

namespace sphparam {

namespace {

/// A right angle whose longer side is `size` long, after a face without area.
TriangleMesh corner(double size) {
  TriangleMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.positions << 0, 0, 0, 0.25, 0, 0, 1, 0, 0, 0, 0, 0.5;
  mesh.positions *= size;
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    require_measurable(mesh);
  } catch (const UnmeasurableMesh& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("measurable: a mesh of an extent between 1e-60 and 1e60, told which of both is missed") {
  const std::string mapped = "this mesh can be mapped but not fitted: it is too ",
                    range = ", its extent is not between 1e-60 and 1e60; scale it";
  for (const double size : {1.0, std::nextafter(1e-60, 1), 3e-60, 3e59, std::nextafter(1e60, 1)}) {
    INFO(size);
    CHECK(refusal(corner(size)) == "");
  }
  for (const double size : {1e-60, 4e-61, 1e-300})
    CHECK(refusal(corner(size)) == mapped + "small" + range);
  for (const double size : {1e60, 3e60, 1e308})
    CHECK(refusal(corner(size)) == mapped + "large" + range);
}

TEST_CASE("measurable: points, and faces along a line that misses the origin, have no area") {
  const std::string without_area =
      "this mesh can be mapped but not fitted: it has no area, distances to it mean nothing";
  TriangleMesh flat = corner(2);
  flat.positions.row(3) << 0.5, 0, 0;
  flat.positions.col(1).array() += 1;
  CHECK(refusal(flat) == without_area);
  flat.positions.setConstant(3);
  CHECK(refusal(flat) == without_area);
}

TEST_CASE("measurable: the diagonal of the box about points") {
  Points points(3, 3);
  points << 5, 1, -7, 6, -1, -7, 5.5, 0, -9;
  CHECK(diagonal_of(points) == 3);
  CHECK(diagonal_of(points.topRows(1)) == 0);
}

}  // namespace sphparam
