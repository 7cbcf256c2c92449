#include <catch2/catch.hpp>
#include <cmath>

#include "sphparam/correspondence/carried_shape.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

MappedMesh ball(int level, double arm = 0) {
  MeshFile file;
  file.mesh = icosphere(level);
  SphereMap map{file.mesh.positions};
  const Vector3 tip = Vector3(0.6, 0.64, 0.48);
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) {
    const Vector3 x = file.mesh.position(v);
    file.mesh.positions.row(v) = (1 + arm * std::exp(-400 * (x - tip).squaredNorm())) * x;
  }
  return MappedMesh({.file = std::move(file), .map = std::move(map)});
}

}  // namespace

TEST_CASE("carried shape: vertices lie on the other surface, normals are its own there") {
  const SurfaceMap map(ball(2), ball(4));
  const CarriedShape shape = carried_shape(map);
  CHECK(shape.mesh.triangles == map.from().mesh().triangles);
  CHECK(shape.mesh.positions == map.from_on_to().positions);
  for (Vertex v = 0; v < shape.mesh.vertex_count(); ++v) {
    CHECK(shape.normals.row(v).norm() == Approx(1));
    CHECK(shape.normals.row(v).dot(shape.mesh.positions.row(v)) > 0.99);
  }
}

TEST_CASE("carried shape: nothing is missed of the shape itself") {
  const CarriedFidelity same = measure_carried({ball(3), ball(3)});
  CHECK(same.farthest < 1e-12);
  CHECK(same.rms < 1e-12);
  CHECK(same.area_share == Approx(1));
}

TEST_CASE("carried shape: an arm under one triangle is missed, and told by its length") {
  const MappedMesh armed = ball(5, 2);
  const CarriedFidelity coarse = measure_carried({ball(1), armed});
  const CarriedFidelity fine = measure_carried({ball(5), armed});
  // The box is about 2 wide and the arm 2 long: most of that is missed.
  CHECK(coarse.farthest > 0.3);
  CHECK(coarse.rms < coarse.farthest);
  CHECK(coarse.area_share < 0.95);
  CHECK(fine.farthest < 0.01);
}

TEST_CASE("carried shape: the same for one thread and three") {
  const SurfaceMap map(ball(2), ball(4, 1));
  const CarriedFidelity one = measure_carried(map, 1), three = measure_carried(map, 3);
  CHECK(one.farthest == three.farthest);
  CHECK(one.rms == three.rms);
  CHECK(placement_on(map, Placement::Scaled, 1).rotation ==
        placement_on(map, Placement::Scaled, 3).rotation);
}

}  // namespace sphparam::tests
