#include <catch2/catch.hpp>

#include "bake/inside_out.h"
#include "sphparam/io/fillers.h"
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

TEST_CASE("inside_out: a sheet whose hole is kept has no inside, a body with a hole has") {
  for (const double size : {1e-200, 1.0, 1e200}) {
    for (const double below : {-0.5, 0.0}) {  // a quarter of the ball is filler, or half of it
      MeshFile file;
      file.mesh = icosphere(3);
      SphereMap map{-file.mesh.positions};
      file.mesh.triangles.col(1).swap(file.mesh.triangles.col(2));
      FillerMarks fillers;
      for (const auto& face : file.mesh.triangles.rowwise())
        fillers.push_back(file.mesh.position(face[0]).z() < below ? 1 : 0);
      mark_fillers(file, fillers);
      file.mesh.positions *= size;
      const MappedMesh mapped({.file = std::move(file), .map = std::move(map), .name = "ball"});
      CHECK(is_inside_out(mapped) == (below < 0));
    }
  }
}

}  // namespace sphparam::tests
