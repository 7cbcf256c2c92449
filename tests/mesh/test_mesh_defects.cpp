#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "sphparam/mesh/mesh_defects.h"
#include "support/joined.h"
#include "support/test_meshes.h"
#include "support/torus.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

const MeshDefect* find(const MeshInspection& inspection, DefectKind kind) {
  for (const MeshDefect& defect : inspection.defects) {
    if (defect.kind == kind) return &defect;
  }
  return nullptr;
}

}  // namespace

TEST_CASE("mesh_defects: a sphere has none, genus 0, and the right size") {
  const MeshInspection inspection = inspect_mesh(icosphere(3));
  CHECK(inspection.defects.empty());
  CHECK(inspection.is_sphere());
  CHECK(inspection.genus == 0);
  CHECK(inspection.components == 1);
  CHECK(inspection.euler_characteristic == 2);
  CHECK(inspection.edges == 3 * inspection.faces / 2);
  CHECK(inspection.volume == Approx(4.0 / 3 * 3.14159265).epsilon(0.02));
  CHECK(inspection.area == Approx(4 * 3.14159265).epsilon(0.02));
}

TEST_CASE("mesh_defects: of points alone it is said what makes a surface of them") {
  TriangleMesh points = icosphere(0);
  points.triangles.resize(0, 3);
  const MeshInspection found = inspect_mesh(points);
  REQUIRE(found.defects.size() == 2);
  CHECK(found.defects[0].kind == DefectKind::Empty);
  CHECK(found.defects[0].message ==
        "the mesh has no faces (of points alone a surface has to be made first, as by Poisson "
        "reconstruction in MeshLab or CloudCompare)");
  CHECK(found.defects[1].kind == DefectKind::UnusedVertex);
}

TEST_CASE("mesh_defects: a torus has genus 1 and nothing else wrong") {
  const MeshInspection inspection = inspect_mesh(torus(8, 8, 3, 1));
  REQUIRE(inspection.defects.size() == 1);
  CHECK(inspection.defects[0].kind == DefectKind::WrongGenus);
  CHECK(inspection.genus == 1);
  CHECK_THROWS_WITH(require_sphere(torus(8, 8, 3, 1)),
                    "the mesh is not a closed genus-0 manifold; genus 1 (Euler characteristic 0): "
                    "only surfaces without handles map to the sphere");
}

TEST_CASE("mesh_defects: a torus beside two spheres has characteristic 4 and is still refused") {
  TriangleMesh mesh = joined(joined(torus(8, 8, 3, 1), octahedron()), tetrahedron());
  CHECK_THROWS_AS(require_sphere(mesh), MeshError);
  const MeshInspection inspection = inspect_mesh(mesh);
  REQUIRE(find(inspection, DefectKind::SeveralComponents));
  CHECK(find(inspection, DefectKind::SeveralComponents)->count == 3);
}

TEST_CASE("mesh_defects: a missing face is three boundary edges in one loop") {
  TriangleMesh mesh = octahedron();
  mesh.triangles.conservativeResize(7, 3);
  const MeshInspection inspection = inspect_mesh(mesh);
  const MeshDefect* defect = find(inspection, DefectKind::BoundaryEdge);
  REQUIRE(defect);
  CHECK(defect->fatal);
  CHECK(defect->count == 3);
  CHECK(inspection.boundary_loops == 1);
  CHECK(defect->elements.size() == 6);  // pairs of vertices
}

TEST_CASE("mesh_defects: two spheres that share a vertex touch there") {
  TriangleMesh mesh = joined(octahedron(), octahedron());
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    int& v = mesh.triangles.data()[i];
    if (v == 6) v = 0;
  }
  const MeshInspection inspection = inspect_mesh(mesh);
  const MeshDefect* defect = find(inspection, DefectKind::NonManifoldVertex);
  REQUIRE(defect);
  CHECK(defect->elements == std::vector<int>{0});
  CHECK(find(inspection, DefectKind::UnusedVertex)->elements == std::vector<int>{6});
  CHECK_THROWS_AS(require_sphere(mesh), MeshError);
}

TEST_CASE("mesh_defects: every planted fault is named with its place") {
  TriangleMesh mesh = icosphere(1);
  SECTION("an index out of range") {
    mesh.triangles(5, 1) = 4711;
    const MeshInspection inspection = inspect_mesh(mesh);
    REQUIRE(find(inspection, DefectKind::IndexOutOfRange));
    CHECK(find(inspection, DefectKind::IndexOutOfRange)->elements == std::vector<int>{5});
  }
  SECTION("a face that names a vertex twice") {
    mesh.triangles(5, 1) = mesh.triangles(5, 0);
    const MeshInspection inspection = inspect_mesh(mesh);
    REQUIRE(find(inspection, DefectKind::RepeatedVertex));
    CHECK(find(inspection, DefectKind::RepeatedVertex)->elements == std::vector<int>{5});
  }
  SECTION("a face twice") {
    mesh.triangles.conservativeResize(81, 3);
    mesh.triangles.row(80) = mesh.triangles.row(3);
    const MeshInspection inspection = inspect_mesh(mesh);
    REQUIRE(find(inspection, DefectKind::DuplicateFace));
    CHECK(find(inspection, DefectKind::DuplicateFace)->elements == std::vector<int>{80});
    CHECK(find(inspection, DefectKind::NonManifoldEdge)->count == 3);
  }
  SECTION("a face turned over") {
    std::swap(mesh.triangles(7, 0), mesh.triangles(7, 1));
    const MeshInspection inspection = inspect_mesh(mesh);
    REQUIRE(find(inspection, DefectKind::InconsistentOrientation));
    CHECK(find(inspection, DefectKind::InconsistentOrientation)->count == 3);
  }
  SECTION("a position that is not a number") {
    mesh.positions(9, 2) = std::numeric_limits<double>::quiet_NaN();
    const MeshInspection inspection = inspect_mesh(mesh);
    REQUIRE(find(inspection, DefectKind::NonFinitePosition));
    CHECK(find(inspection, DefectKind::NonFinitePosition)->elements == std::vector<int>{9});
  }
  CHECK_FALSE(inspect_mesh(mesh).is_sphere());
  CHECK_THROWS_AS(require_sphere(mesh), MeshError);
}

TEST_CASE("mesh_defects: what is odd but harmless is reported and does not stop the map") {
  TriangleMesh mesh = icosphere(1);
  SECTION("coincident vertices, and the faces between them without area") {
    mesh.positions.row(1) = mesh.positions.row(mesh.triangles(0, 1));
    const Vertex moved = 12;
    mesh.positions.row(moved) = mesh.positions.row(mesh.triangles(0, 0));
    const MeshInspection inspection = inspect_mesh(mesh);
    CHECK(inspection.is_sphere());
    CHECK(find(inspection, DefectKind::CoincidentVertices));
    CHECK(find(inspection, DefectKind::ZeroAreaFace));
  }
  SECTION("inside out") {
    mesh.triangles.col(0).swap(mesh.triangles.col(1));
    const MeshInspection inspection = inspect_mesh(mesh);
    CHECK(inspection.is_sphere());
    CHECK(find(inspection, DefectKind::InsideOut));
  }
  CHECK_NOTHROW(require_sphere(mesh));
}

TEST_CASE("mesh_defects: faces without any vertex are listed") {
  TriangleMesh mesh = icosphere(0);
  mesh.positions.resize(0, 3);
  const MeshInspection inspection = inspect_mesh(mesh);
  REQUIRE(find(inspection, DefectKind::IndexOutOfRange));
  CHECK(find(inspection, DefectKind::IndexOutOfRange)->count == mesh.face_count());
}

TEST_CASE("mesh_defects: huge and tiny coordinates are measured without overflow") {
  for (const double scale : {1e300, 1e-300}) {
    TriangleMesh mesh = icosphere(1);
    mesh.positions *= scale;
    const MeshInspection inspection = inspect_mesh(mesh);
    CHECK(inspection.is_sphere());
    CHECK_FALSE(find(inspection, DefectKind::ZeroAreaFace));
    CHECK_FALSE(find(inspection, DefectKind::InsideOut));
  }
}

TEST_CASE("mesh_defects: corners at both ends of the doubles are measured, as far as these reach") {
  TriangleMesh mesh = octahedron();
  mesh.positions *= 1.7e308;  // twice that is no double
  const MeshInspection inspection = inspect_mesh(mesh);
  CHECK(inspection.is_sphere());
  CHECK(inspection.defects.empty());
  CHECK(inspection.area == std::numeric_limits<double>::infinity());
  CHECK(inspection.volume == std::numeric_limits<double>::infinity());
  mesh = octahedron();
  mesh.positions = (mesh.positions.array() + 1) * std::numeric_limits<double>::denorm_min();
  CHECK(inspect_mesh(mesh).area == 0);
  CHECK(inspect_mesh(mesh).volume == 0);
}

TEST_CASE("mesh_defects: whether faces have area is told alike at every size") {
  TriangleMesh flat = octahedron();  // two faces have none
  flat.positions.row(flat.triangles(0, 1)) = flat.position(flat.triangles(0, 0));
  for (int exponent = -300; exponent <= 300; exponent += 10) {
    INFO("1e" << exponent);
    const double size = std::pow(10.0, exponent);
    TriangleMesh mesh = octahedron();
    mesh.positions *= size;
    CHECK(inspect_mesh(mesh).defects.empty());
    mesh.positions = size * flat.positions;
    const MeshInspection inspection = inspect_mesh(mesh);
    REQUIRE(find(inspection, DefectKind::ZeroAreaFace));
    CHECK(find(inspection, DefectKind::ZeroAreaFace)->count == 2);
  }
}

TEST_CASE(
    "mesh_defects: a surface in one place has no size, one far off keeps the digits of its own") {
  TriangleMesh mesh = icosphere(1);
  const MeshInspection alone = inspect_mesh(mesh);
  mesh.positions.array() += 1e6;
  CHECK(inspect_mesh(mesh).volume == Approx(alone.volume).epsilon(1e-8));
  CHECK(inspect_mesh(mesh).area == Approx(alone.area).epsilon(1e-8));
  mesh.positions.setConstant(3);
  CHECK(inspect_mesh(mesh).volume == 0);
  CHECK(inspect_mesh(mesh).area == 0);
}

TEST_CASE("mesh_defects: an unused vertex, however far off, changes no size") {
  TriangleMesh mesh = icosphere(1);
  const MeshInspection alone = inspect_mesh(mesh);
  mesh.positions.conservativeResize(43, 3);
  for (const double far : {7.0, 1e17, 1e300}) {
    mesh.positions.row(42) << far, 0, 0;
    const MeshInspection inspection = inspect_mesh(mesh);
    CHECK(inspection.area == alone.area);
    CHECK(inspection.volume == alone.volume);
    CHECK(inspection.upper == alone.upper);
    CHECK(inspection.defects.size() == 1);
  }
}

TEST_CASE("mesh_defects: an empty mesh is refused") {
  CHECK_FALSE(inspect_mesh(TriangleMesh{}).is_sphere());
  CHECK_THROWS_AS(require_sphere(TriangleMesh{}), MeshError);
}

TEST_CASE("mesh_defects: two faces back to back are no surface") {
  TriangleMesh mesh;
  mesh.positions = Points::Identity(3, 3);
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 1;
  CHECK_FALSE(inspect_mesh(mesh).is_sphere());
  CHECK_THROWS_AS(require_sphere(mesh), MeshError);
}

TEST_CASE("mesh_defects: an unused vertex is a remark, and the surface is still seen as a sphere") {
  TriangleMesh mesh = icosphere(1);
  mesh.positions.conservativeResize(43, 3);
  mesh.positions.row(42) << 7, 7, 7;
  const MeshInspection inspection = inspect_mesh(mesh);
  CHECK(inspection.is_sphere());
  CHECK(inspection.genus == 0);
  CHECK(inspection.used_vertices == 42);
  REQUIRE(find(inspection, DefectKind::UnusedVertex));
  CHECK(find(inspection, DefectKind::UnusedVertex)->elements == std::vector<int>{42});
  CHECK(find(inspection, DefectKind::UnusedVertex)->hint.find("in arrays remove them") !=
        std::string::npos);
  CHECK_THROWS_AS(require_sphere(mesh), MeshError);
}
