#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/enclosed_volume.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

TEST_CASE("enclosed: volume against area, with the sense of the faces, at any size and place") {
  const TriangleMesh four = tetrahedron();  // regular: V = a³/(6√2), A = √3 a²
  const double of_tetrahedron = 1 / (6 * std::sqrt(2) * std::pow(3, 0.75));
  for (const double size : {1e-200, 1.0, 1e200, 1.7e308}) {
    for (const double aside : {0.0, 0.5}) {
      INFO(size << " " << aside);
      TriangleMesh mesh = four;
      mesh.positions /= mesh.positions.cwiseAbs().maxCoeff();
      if (aside > 0) mesh.positions = (mesh.positions.array() * 0.4 + aside).matrix();
      mesh.positions *= size;
      CHECK(enclosed(mesh) == Approx(of_tetrahedron).epsilon(1e-12));
      mesh.triangles.col(1).swap(mesh.triangles.col(2));
      CHECK(enclosed(mesh) == Approx(-of_tetrahedron).epsilon(1e-12));
    }
  }
}

TEST_CASE("enclosed: a sheet encloses nothing, and a point has no number") {
  TriangleMesh mesh = icosphere(2);
  mesh.positions.col(2).setZero();
  CHECK(std::abs(enclosed(mesh)) < 1e-15);
  mesh.positions.setZero();
  CHECK(std::isnan(enclosed(mesh)));
}

}  // namespace sphparam::tests
