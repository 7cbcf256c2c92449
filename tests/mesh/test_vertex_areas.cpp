#include <catch2/catch.hpp>

#include "sphparam/mesh/vertex_areas.h"
#include "support/cube.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("vertex areas: each triangle gives its corners a third") {
  const TriangleMesh mesh = cube();  // sides of 2: triangles of area 2
  const VectorX areas = vertex_areas(mesh);
  VectorX triangles = VectorX::Zero(8);
  for (const int v : mesh.triangles.reshaped()) triangles[v] += 1;
  CHECK((areas - triangles * (2.0 / 3)).norm() < 1e-14);
  CHECK(areas.sum() == Approx(24));
}
