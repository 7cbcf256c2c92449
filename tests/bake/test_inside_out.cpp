#include <catch2/catch.hpp>

#include "bake/inside_out.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

TEST_CASE("inside_out: faces that look inward are told, whatever the size and place") {
  for (const double size : {1e-200, 1.0, 1e200}) {
    for (const double aside : {0.0, 1000.0}) {
      INFO(size << " " << aside);
      TriangleMesh mesh = icosphere(2);
      mesh.positions.array() += aside;
      mesh.positions *= size;
      CHECK_FALSE(is_inside_out(mesh));
      mesh.triangles.col(1).swap(mesh.triangles.col(2));
      CHECK(is_inside_out(mesh));
    }
  }
}

TEST_CASE("inside_out: what encloses nothing has no inside") {
  TriangleMesh flat = icosphere(2);
  flat.positions.col(2).setZero();
  CHECK_FALSE(is_inside_out(flat));
  flat.triangles.col(1).swap(flat.triangles.col(2));
  CHECK_FALSE(is_inside_out(flat));
}

}  // namespace sphparam::tests
