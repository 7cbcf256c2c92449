#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "correspondence/target_surface.h"
#include "mesh/triangle_geometry.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

MappedMesh mapped(TriangleMesh mesh) {
  SphereMap map = parameterize(mesh).map;
  MeshFile file;
  file.mesh = std::move(mesh);
  return MappedMesh({.file = std::move(file), .map = std::move(map)});
}

}  // namespace

TEST_CASE("target surface: a walk is as long as its way, also over edges") {
  // Round a tube, whose faces unfold into a plane: along it nothing turns.
  const MappedMesh shape = mapped(icosphere(4));
  const TargetSurface target(shape);
  const Place from = target.place(Vector3(0.3, -0.5, 0.8));
  const PlaceFrame& frame = from.frame;
  for (const double length : {0.001, 0.1, 1.0}) {
    const Place to = target.walk(from, length * frame.u);
    CHECK(angle_between(from.position, to.position) == Approx(length).epsilon(0.01));
    // Straight on the surface is a great circle here.
    const Vector3 pole = from.position.cross(frame.u).normalized();
    CHECK(std::abs(pole.dot(to.position)) < 0.02 * length + 0.01);
  }
}

TEST_CASE("target surface: there and back ends where it began") {
  const MappedMesh shape = mapped(random_sphere_mesh(300, 4));
  const TargetSurface target(shape);
  const Place from = target.place(Vector3(1, 0.2, -0.4));
  const PlaceFrame& frame = from.frame;
  const Vector3 way = 0.01 * (frame.u + 2 * frame.v);  // within a face or two
  const Place to = target.walk(from, way);
  CHECK((to.position - from.position).norm() < 1.1 * way.norm());  // which rounding may bulge
  if (to.at.face == from.at.face) {
    const Place back = target.walk(to, -way);
    CHECK((back.position - from.position).norm() < 1e-12);
  }
}

TEST_CASE("target surface: place and direction belong together") {
  const MappedMesh shape = mapped(random_sphere_mesh(300, 4));
  const TargetSurface target(shape);
  const Place from = target.place(Vector3(0.1, 0.7, 0.2).normalized());
  CHECK(from.direction == Vector3(0.1, 0.7, 0.2).normalized());
  const PlaceFrame& frame = from.frame;
  const Place to = target.walk(from, 0.7 * frame.v);
  const Place same = target.place(to.direction);
  CHECK((same.position - to.position).norm() < 1e-12);
}

TEST_CASE("target surface: position and direction change as the frame says") {
  const MappedMesh shape = mapped(random_sphere_mesh(300, 9));
  const TargetSurface target(shape);
  const Place from = target.place(Vector3(-0.4, 0.7, 0.2));
  const double h = 1e-7;
  const Place ahead = target.walk(from, h * from.frame.u),
              behind = target.walk(from, -h * from.frame.u);
  REQUIRE(ahead.at.face == behind.at.face);
  CHECK(((ahead.position - behind.position) / (2 * h) - from.frame.of_u).norm() < 1e-6);
  CHECK(((ahead.direction - behind.direction) / (2 * h) - from.frame.turn_u).norm() < 1e-6);
}

TEST_CASE("target surface: the vertices of the mesh are places of it") {
  const MappedMesh shape = mapped(random_sphere_mesh(50, 3));
  const TargetSurface target(shape);
  const Points scaled = scaled_to_sphere(shape.mesh());
  for (Vertex v = 0; v < 50; ++v)
    CHECK((target.place(shape.map().point(v)).position - Vector3(scaled.row(v))).norm() < 1e-12);
}

TEST_CASE("target surface: it is scaled to the area of the sphere") {
  TriangleMesh mesh = icosphere(2);
  mesh.positions *= 17;
  mesh.positions.rowwise() += Eigen::RowVector3d(4, 5, 6);
  const Points scaled = scaled_to_sphere(mesh);
  double area = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) -> Vector3 { return scaled.row(mesh.triangles(f, k)); };
    area += triangle_area(corner(0), corner(1), corner(2));
  }
  CHECK(area == Approx(4 * std::numbers::pi));
  CHECK(scaled.colwise().mean().norm() < 1e-12);
}

}  // namespace sphparam::tests
