#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "mesh/repair/weld_shares.h"
#include "support/joined.h"
#include "support/rows_and_columns.h"
#include "support/shaken.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

using Shares = std::vector<double>;

TEST_CASE("weld_shares: above the errors of a mesh, and well below its edges, at any size") {
  const Shares usual = weld_shares(shaken_apart(icosphere(3), 1e-5));
  CHECK(usual == Shares{5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3});
  CHECK(weld_shares(shaken_apart(icosphere(3), 1e-7)).front() == 5e-7);
  CHECK(weld_shares(shaken_apart(icosphere(5), 1e-5)).back() == 2e-3);
  CHECK(weld_shares(shaken_apart(icosphere(3), 1e-2)).empty());
  for (const double size : {1e-150, 1e150}) {
    TriangleMesh mesh = shaken_apart(icosphere(3), 1e-5);
    mesh.positions *= size;
    CHECK(weld_shares(mesh) == usual);
  }
}

TEST_CASE("weld_shares: an unused vertex far off changes none") {
  TriangleMesh mesh = shaken_apart(icosphere(3), 1e-5);
  const Shares usual = weld_shares(mesh);
  const Eigen::Index vertices = mesh.vertex_count();
  mesh.positions.conservativeResize(vertices + 1, 3);
  mesh.positions.row(vertices) << 1000, 0, 0;
  CHECK(weld_shares(mesh) == usual);
}

TEST_CASE("weld_shares: none where boundaries are the shape's, or nothing has a place") {
  TriangleMesh open = icosphere(3);
  open.triangles.conservativeResize(open.face_count() - 20, 3);
  CHECK(weld_shares(open).empty());
  CHECK(weld_shares(joined(open, open, {3, 0, 0})).empty());
  CHECK(weld_shares(icosphere(2)).empty());
  CHECK(weld_shares({}).empty());
  TriangleMesh point = shaken_apart(icosphere(1), 0);
  point.positions.setZero();
  CHECK(weld_shares(point).empty());
  TriangleMesh absent = shaken_apart(icosphere(1), 1e-5);
  absent.positions(3, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(weld_shares(absent).empty());
}

TEST_CASE(
    "weld_shares: few vertices torn apart by the rounding of float32 have that of its steps") {
  for (const double away : {0.0, 100.0}) {
    TriangleMesh mesh = icosphere(3);
    mesh.positions.col(0).array() += away;
    const auto old = mesh.vertex_count();
    mesh.positions.conservativeResize(old + 1, 3);
    mesh.positions.row(old) = mesh.position(mesh.triangles(0, 0));
    mesh.triangles(0, 0) = static_cast<Vertex>(old);
    double& x = mesh.positions(old, 0);
    x = std::nextafter(static_cast<float>(x), 1000.F);
    CHECK(weld_shares(mesh) == Shares{away > 0 ? 2e-5 : 2e-7});
    x += 0.01;  // a shape
    CHECK(weld_shares(mesh).empty());
  }
}

TEST_CASE("weld_shares: a vertex that rounding keeps off an edge has the share of its steps too") {
  TriangleMesh mesh = icosphere(2);
  const Vertex a = mesh.triangles(0, 0), b = mesh.triangles(0, 1), c = mesh.triangles(0, 2),
               middle = static_cast<Vertex>(mesh.vertex_count());
  mesh.positions.conservativeResize(middle + 1, 3);
  mesh.triangles(0, 1) = middle;
  mesh.triangles.conservativeResize(mesh.face_count() + 1, 3);
  mesh.triangles.bottomRows(1) << middle, b, c;
  for (const double off : {1e-8, 1e-2}) {
    mesh.positions.row(middle) = (1 + off) * (mesh.position(a) + mesh.position(b)) / 2;
    CHECK(weld_shares(mesh) == (off < 1e-6 ? Shares{2e-7} : Shares{}));
  }
}

TEST_CASE("weld_shares: a tenth of short edges, few single vertices and odd faces change nothing") {
  TriangleMesh mesh = joined(shaken_apart(icosphere(3), 1e-5), octahedron(), {0, 0, 0});
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);  // a hole with three vertices
  mesh.triangles(0, 0) = 1 << 20;
  mesh.triangles(1, 1) = -3;
  CHECK(weld_shares(mesh) == weld_shares(shaken_apart(icosphere(3), 1e-5)));
  // Faces that name a vertex twice have a side without length, which is no edge of a boundary.
  const Eigen::Index faces = mesh.face_count();
  mesh.triangles.conservativeResize(2 * faces, 3);
  for (Eigen::Index f = faces; f < 2 * faces; ++f)
    mesh.triangles.row(f) << mesh.triangles(f - faces, 2), mesh.triangles(f - faces, 2), 0;
  CHECK(weld_shares(mesh) == weld_shares(shaken_apart(icosphere(3), 1e-5)));
}

TEST_CASE("weld_shares: edges of a row that lies at a pole, but for rounding, are none") {
  const Shares all = weld_shares(rows_and_columns(19, 36));
  CHECK(all.size() == 19);
  CHECK(all.back() == 1e-2);
}
