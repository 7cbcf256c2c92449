#include <catch2/catch.hpp>
#include <cmath>

#include "sphparam/correspondence/carried_shape.h"
#include "sphparam/parameterize.h"
#include "support/capped.h"
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

/// An egg whose cap closes a hole that was kept.
MappedMesh capped_egg(double cap, double length = 1) {
  TriangleMesh egg = icosphere(3);
  egg.positions.col(0) *= length;
  return capped(std::move(egg), icosphere(3).positions, cap);
}

}  // namespace

TEST_CASE("carried shape: fillers are no surface, wherever they lie") {
  const CarriedFidelity flat = measure_carried({capped_egg(1), capped_egg(1, 2)}),
                        high = measure_carried({capped_egg(1.4), capped_egg(3, 2)});
  CHECK(high.farthest == Approx(flat.farthest).margin(1e-9));
  CHECK(high.rms == Approx(flat.rms).margin(1e-9));
  CHECK(high.area_share == Approx(flat.area_share));
}

TEST_CASE("surface map: fillers are in no figure of its distortion, wherever they lie") {
  const auto figures = [](double first_cap, double second_cap) {
    return summarise_distortion({capped_egg(first_cap), capped_egg(second_cap, 2)});
  };
  const DistortionSummary flat = figures(1, 1), high = figures(1.4, 3);
  CHECK(flat.mean_abs_ln_area > 0.1);
  CHECK(high.mean_abs_ln_area == Approx(flat.mean_abs_ln_area));
  CHECK(high.mean_abs_ln_angle == Approx(flat.mean_abs_ln_angle));
  CHECK(high.symmetric_dirichlet == Approx(flat.symmetric_dirichlet));
  CHECK(high.area_ratio_max == Approx(flat.area_ratio_max));
  CHECK(high.flat_faces == 0);
  const SurfaceMap map(capped_egg(1.4), capped_egg(3, 2));
  const Distortion distortion = measure_distortion(map);
  CHECK(distortion.source_area.sum() == Approx(1));
  CHECK(distortion.source_area.dot(distortion.area_ratio) == Approx(1));
}

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
