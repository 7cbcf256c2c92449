#include <catch2/catch.hpp>
#include <stdexcept>

#include "sphparam/measure/growth.h"

using namespace sphparam;

namespace {

/// Two triangles on one edge; a third without area.
TriangleMesh kite(double height) {
  TriangleMesh mesh{Points(5, 3), Triangles(3, 3)};
  mesh.positions << 0, 0, 0, 2, 0, 0, 0, height, 0, 0, -1, 0, 1, 0, 0;
  mesh.triangles << 0, 1, 2, 1, 0, 3, 0, 4, 1;
  return mesh;
}

}  // namespace

TEST_CASE("growth: of triangles, of what is about a vertex, and of all") {
  const Growth growth = measure_growth(kite(1), kite(4));
  CHECK(growth.faces == VectorX(Vector3(4, 1, 0)));
  CHECK(growth.vertices.head(4) == VectorX(Eigen::Vector4d(2.5, 2.5, 4, 1)));
  CHECK(growth.vertices[4] == 0);  // nothing is about it
  CHECK(growth.total == 2.5);
  const Growth back = measure_growth(kite(4), kite(1));
  CHECK(back.faces == VectorX(Vector3(0.25, 1, 0)));
  CHECK(back.total == 0.4);
}

TEST_CASE("growth: where there was nothing, and where doubles do not hold it, it is 0") {
  CHECK(measure_growth(kite(0), kite(1)).faces == VectorX(Vector3(0, 1, 0)));
  CHECK(measure_growth(kite(1e-160), kite(1e160)).faces == VectorX(Vector3(0, 1, 0)));
}

TEST_CASE("growth: other triangles are refused, also as many") {
  TriangleMesh other = kite(1);
  other.triangles.row(1) << 0, 3, 1;
  CHECK_THROWS_AS(measure_growth(kite(1), other), std::invalid_argument);
  other = kite(1);
  other.triangles.conservativeResize(2, 3);
  CHECK_THROWS_AS(measure_growth(kite(1), other), std::invalid_argument);
  other = kite(1);
  other.positions.conservativeResize(6, 3);
  CHECK_THROWS_AS(measure_growth(kite(1), other), std::invalid_argument);
}
