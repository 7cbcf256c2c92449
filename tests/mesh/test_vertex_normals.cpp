#include <catch2/catch.hpp>
#include <cmath>

#include "mesh/vertex_normals.h"

using namespace sphparam;

namespace {

/// [−1, 1]³ · size from outside, and a vertex that no face uses.
TriangleMesh cube(double size) {
  TriangleMesh mesh{Points(9, 3), Triangles(12, 3)};
  for (int v = 0; v < 9; ++v)
    mesh.positions.row(v) << (v & 1 ? size : -size), (v & 2 ? size : -size), (v & 4 ? size : -size);
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6,
      0, 6, 2, 1, 3, 7, 1, 7, 5;
  return mesh;
}

}  // namespace

TEST_CASE(
    "vertex_normals: by area as many times a side's as it has triangles there, by angle once") {
  for (const double size : {1.0, 1e-300, 1e-130, 1e200, 1e308}) {
    INFO(size);
    const TriangleMesh mesh = cube(size);
    Points expected = Points::Zero(8, 3);
    for (Face f = 0; f < 12; ++f) {
      const int axis = 2 - f / 4;  // sides of z, of y, of x
      for (int k = 0; k < 3; ++k) {
        const Vertex v = mesh.triangles(f, k);
        expected(v, axis) += mesh.positions(v, axis) > 0 ? 1 : -1;
      }
    }
    const Points by_area = vertex_normals(mesh), by_angle = angle_weighted_normals(mesh);
    for (Vertex v = 0; v < 8; ++v) {
      CHECK((by_area.row(v) - expected.row(v).normalized()).norm() < 1e-15);
      const Vector3 corner = mesh.position(v) / size;
      CHECK((by_angle.row(v) - corner.transpose() / std::sqrt(3.0)).norm() < 1e-15);
    }
  }
}

TEST_CASE("vertex_normals: upwards where no face is, or none has area") {
  TriangleMesh mesh = cube(1);
  CHECK(vertex_normals(mesh).row(8) == Vector3::UnitZ().transpose());
  CHECK(angle_weighted_normals(mesh).row(8) == Vector3::UnitZ().transpose());
  mesh.positions.setConstant(2);
  for (Vertex v = 0; v < 9; ++v) {
    CHECK(vertex_normals(mesh).row(v) == Vector3::UnitZ().transpose());
    CHECK(angle_weighted_normals(mesh).row(v) == Vector3::UnitZ().transpose());
  }
}
