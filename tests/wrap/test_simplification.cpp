#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/topology.h"
#include "support/test_meshes.h"
#include "wrap/quadric.h"
#include "wrap/simplification.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

double volume_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& f : mesh.triangles.rowwise())
    sum += mesh.position(f[0]).dot(mesh.position(f[1]).cross(mesh.position(f[2]))) / 6;
  return sum;
}

TriangleMesh bumpy_cube() {
  TriangleMesh mesh = icosphere(5);
  for (auto row : mesh.positions.rowwise()) row /= row.cwiseAbs().maxCoeff();
  return mesh;
}

}  // namespace

TEST_CASE("simplification: a sphere of few triangles is as good as that many can be") {
  for (const long triangles : {4L, 20L, 320L, 5000L}) {
    const TriangleMesh mesh = simplified(icosphere(5), triangles);
    CHECK(inspect_mesh(mesh).is_sphere());
    CHECK(mesh.face_count() <= triangles);
    CHECK(mesh.face_count() >= triangles - 1);
    // Of a polyhedron with F equal faces about the sphere's size the volume is off by some 10 / F.
    if (triangles >= 320)
      CHECK(volume_of(mesh) == Approx(4.18879).epsilon(10.0 / static_cast<double>(triangles)));
  }
}

TEST_CASE("simplification: faces of a cube stay flat, its edges where they are") {
  const TriangleMesh mesh = simplified(bumpy_cube(), 2000);
  REQUIRE(inspect_mesh(mesh).is_sphere());
  CHECK(volume_of(mesh) == Approx(8).epsilon(0.01));
  int off = 0;
  for (const auto& row : mesh.positions.rowwise())
    off += std::abs(row.cwiseAbs().maxCoeff() - 1) > 0.02;
  CHECK(off < mesh.vertex_count() / 20);
}

TEST_CASE("simplification: what is few enough stays as it is, far from the origin, it is as good") {
  const TriangleMesh few = icosphere(1);
  CHECK(simplified(few, 80).triangles == few.triangles);
  TriangleMesh far = icosphere(4);
  far.positions.array() += 1e6;
  TriangleMesh made = simplified(far, 200);
  made.positions.array() -= 1e6;
  CHECK(volume_of(made) == Approx(volume_of(simplified(icosphere(4), 200))).epsilon(0.01));
}

TEST_CASE("simplification: the shortest edge goes first, whichever vertices it joins") {
  for (const Vertex v : {0, 1, 17, 41}) {
    TriangleMesh mesh = icosphere(1);
    const Vertex w =
        mesh.triangles(Topology(mesh).outgoing(v) / 3, (Topology(mesh).outgoing(v) + 1) % 3);
    mesh.positions.row(v) = 0.001 * mesh.positions.row(v) + 0.999 * mesh.positions.row(w);
    const TriangleMesh made = simplified(mesh, 78);
    CHECK(made.face_count() == 78);
    for (const auto& place : mesh.positions.rowwise())  // all others stay
      CHECK((made.positions.rowwise() - place).rowwise().norm().minCoeff() < 0.01);
  }
}

TEST_CASE("simplification: however large or small, the same triangles, at the same places") {
  const TriangleMesh mesh = bumpy_cube(), made = simplified(mesh, 500);
  for (const int exponent : {-199, -180, 3, 180, 230}) {
    INFO(exponent);
    const double size = std::ldexp(1.0, exponent);
    const TriangleMesh other = simplified({size * mesh.positions, mesh.triangles}, 500);
    CHECK(other.triangles == made.triangles);
    CHECK(other.positions == size * made.positions);
  }
}

TEST_CASE("simplification: whatever the shape, it stays closed and of genus 0") {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0, 0.4);
  for (int trial = 0; trial < 20; ++trial) {
    TriangleMesh mesh = icosphere(4);
    for (double& x : mesh.positions.reshaped()) x += noise(random);
    const TriangleMesh made = simplified(mesh, 100);
    CHECK(inspect_mesh(made).is_sphere());
    CHECK(made.face_count() < mesh.face_count());
  }
}

TEST_CASE("quadric: it is least on the planes that it is of") {
  const Vector3 a(1, 0, 0), b(1, 1, 0), c(1, 0, 1);
  const Quadric plane = Quadric::of_triangle(a, b, c);
  CHECK(plane.at(Vector3(1, 0.3, 0.3)) < 1e-3 * plane.at(Vector3(2, 0.3, 0.3)));
  CHECK(plane.at(Vector3(2, 1.0 / 3, 1.0 / 3)) == Approx(0.5 * 1.001));
  Quadric corner = plane;
  corner += Quadric::of_triangle({0, 2, 0}, {0, 2, 1}, {1, 2, 0});
  corner += Quadric::of_triangle({0, 0, 3}, {1, 0, 3}, {0, 1, 3});
  CHECK((corner.lowest({0, 0, 0}) - Vector3(1, 2, 3)).norm() < 0.02);
  CHECK(Quadric::of_triangle(a, a, b).lowest(c) == c);
}
