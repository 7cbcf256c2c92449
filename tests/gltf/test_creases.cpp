#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "sphparam/io/creases.h"
#include "sphparam/io/fillers.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// From (0, 0, 0) to (2, 3, 5), of 12 triangles.
MeshFile box() {
  MeshFile file;
  file.mesh.positions.resize(8, 3);
  for (int v = 0; v < 8; ++v)
    file.mesh.positions.row(v) << 2 * (v & 1), 3 * (v >> 1 & 1), 5 * (v >> 2 & 1);
  file.mesh.triangles.resize(12, 3);
  file.mesh.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0,
      4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5;
  return file;
}

Vector3 flat(const TriangleMesh& mesh, Eigen::Index face) {
  const auto corner = [&](int k) { return mesh.position(mesh.triangles(face, k)); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
}

/// A cylinder about z with radius 1 between z = 0 and z = 1; the last two vertices are the middles
/// of its caps.
MeshFile cylinder(int sides) {
  MeshFile file;
  file.mesh.positions.resize(2 * sides + 2, 3);
  file.mesh.triangles.resize(4 * sides, 3);
  const int below = 2 * sides, above = below + 1;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    file.mesh.positions.row(i) << std::cos(angle), std::sin(angle), 0;
    file.mesh.positions.row(sides + i) << std::cos(angle), std::sin(angle), 1;
    const int j = (i + 1) % sides;
    file.mesh.triangles.row(4 * i) << i, j, sides + j;
    file.mesh.triangles.row(4 * i + 1) << i, sides + j, sides + i;
    file.mesh.triangles.row(4 * i + 2) << below, j, i;
    file.mesh.triangles.row(4 * i + 3) << above, sides + i, sides + j;
  }
  file.mesh.positions.row(below) << 0, 0, 0;
  file.mesh.positions.row(above) << 0, 0, 1;
  return file;
}

}  // namespace

TEST_CASE("creases: all corners of a box have the normal of their face, at any size") {
  for (const double scale : {1.0, 1e-150, 1e150}) {
    MeshFile file = box();
    file.mesh.positions *= scale;
    REQUIRE(add_creases(file, 30) == 12);  // not the diagonals
    REQUIRE(file.corner_normals);
    REQUIRE(file.corner_normals->rows() == 36);
    for (Eigen::Index corner = 0; corner < 36; ++corner)
      CHECK(Vector3(file.corner_normals->row(corner)) == flat(box().mesh, corner / 3));
  }
}

TEST_CASE("creases: a cylinder is smooth around and hard at its rims") {
  constexpr int sides = 64;
  MeshFile file = cylinder(sides);
  CHECK(add_creases(file, 30) == 2 * sides);
  REQUIRE(file.corner_normals);
  for (Eigen::Index corner = 0; corner < file.corner_normals->rows(); ++corner) {
    const Vector3 normal = file.corner_normals->row(corner);
    const Eigen::Index kind = corner / 3 % 4;
    if (kind == 2) CHECK(normal == Vector3(0, 0, -1));
    if (kind == 3) CHECK(normal == Vector3(0, 0, 1));
    if (kind > 1) continue;
    // Straight outwards, though two of three triangles are of the quad to one side.
    const Vector3 at = file.mesh.position(file.mesh.triangles.data()[corner]);
    CHECK((normal - Vector3(at.x(), at.y(), 0)).norm() < 1e-14);
  }
}

TEST_CASE("creases: an edge that turns by just so many degrees is not hard") {
  MeshFile file = cylinder(12);  // by 30° from side to side
  CHECK(add_creases(file, 30) == 24);
  MeshFile sharper = cylinder(12);
  CHECK(add_creases(sharper, 29.9) == 36);
}

TEST_CASE("creases: what is smooth stays as it is, and so does what has normals") {
  MeshFile ball;
  ball.mesh = icosphere(3);
  CHECK(add_creases(ball, 30) == 0);
  CHECK_FALSE(ball.corner_normals);

  MeshFile own = box();
  for (const char* name : {"nx", "ny", "nz"})
    own.set_vertex_property({name, ScalarType::Float32, std::vector<double>(8, 0.6)});
  CHECK_FALSE(add_creases(own, 30));
  CHECK_FALSE(own.corner_normals);

  MeshFile corners = box();
  corners.corner_normals = CornerNormals::Constant(36, 3, 0.5);
  CHECK_FALSE(add_creases(corners, 30));
  CHECK(*corners.corner_normals == CornerNormals::Constant(36, 3, 0.5));
}

TEST_CASE("creases: faces that are turned over, and edges with more than two, are hard") {
  MeshFile turned = box();
  turned.mesh.triangles.row(0) << 0, 1, 2;  // its neighbour on the same side stays
  REQUIRE(add_creases(turned, 180) == 0);   // of two faces of one orientation
  REQUIRE(turned.corner_normals);
  CHECK(Vector3(turned.corner_normals->row(1)) == Vector3(0, 0, 1));

  MeshFile fin;  // three triangles about the edge from vertex 0 to vertex 1
  fin.mesh.positions.resize(5, 3);
  fin.mesh.positions << 0, 0, 0, 0, 0, 1, 1, 0, 0, -1, 0.1, 0, 0, -1, 0;
  fin.mesh.triangles.resize(3, 3);
  fin.mesh.triangles << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  REQUIRE(add_creases(fin, 180) == 0);
  REQUIRE(fin.corner_normals);
  for (Eigen::Index corner = 0; corner < 9; ++corner)
    CHECK((fin.corner_normals->row(corner).transpose() - flat(fin.mesh, corner / 3)).norm() <
          1e-14);
}

TEST_CASE("creases: a face without area is no edge of its own") {
  MeshFile file = box();
  // A vertex in the middle of the diagonal of the face z = 0, on one side of it alone.
  TriangleMesh& mesh = file.mesh;
  mesh.positions.conservativeResize(9, 3);
  mesh.positions.row(8) << 1, 1.5, 0;
  mesh.triangles.conservativeResize(14, 3);
  mesh.triangles.row(0) << 0, 2, 8;
  mesh.triangles.row(12) << 0, 8, 1;
  mesh.triangles.row(13) << 1, 8, 2;
  CHECK(add_creases(file, 30) == 12);
  REQUIRE(file.corner_normals);
  for (Eigen::Index face : {0, 1, 12, 13})
    for (Eigen::Index k = 0; k < 3; ++k)
      CHECK(Vector3(file.corner_normals->row(3 * face + k)) == Vector3(0, 0, -1));
}

TEST_CASE("creases: the rim of a kept hole is hard, fillers tell nothing of the surface") {
  MeshFile file = box();
  FillerMarks fillers(12, 0);
  fillers[0] = fillers[1] = 1;  // z = 0
  mark_fillers(file, fillers);
  REQUIRE(add_creases(file, 180) == 0);
  CHECK_FALSE(file.corner_normals);  // one fan of surface about each vertex
  CHECK(add_creases(file, 30) == 8);
  REQUIRE(file.corner_normals);
  for (Eigen::Index corner = 6; corner < 36; ++corner)
    CHECK(Vector3(file.corner_normals->row(corner)) == flat(file.mesh, corner / 3));
}

TEST_CASE("creases: angles are from 0 to 180") {
  MeshFile file = box();
  for (const double degrees : {-1.0, 180.5, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(add_creases(file, degrees), std::invalid_argument);
}
