#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "sphparam/mesh/mesh_repair.h"
#include "support/rows_and_columns.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

long count(const RepairedMesh& repaired, RepairKind kind) {
  for (const RepairAction& action : repaired.actions)
    if (action.kind == kind) return action.count;
  return 0;
}

/// Each vertex of the northern half has a copy that the faces of that half use, moved by `gap`.
TriangleMesh cracked_ball(double gap) {
  TriangleMesh mesh = icosphere(3);
  const Eigen::Index vertices = mesh.vertex_count();
  mesh.positions.conservativeResize(2 * vertices, 3);
  for (Eigen::Index v = 0; v < vertices; ++v) {
    mesh.positions.row(vertices + v) = mesh.positions.row(v);
    mesh.positions(vertices + v, 2) += gap;
  }
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    double height = 0;
    for (int k = 0; k < 3; ++k) height += mesh.positions(mesh.triangles(f, k), 2);
    if (height > 0) mesh.triangles.row(f).array() += static_cast<int>(vertices);
  }
  return mesh;
}

/// A box whose top has a vertex amid one edge that the side does not know, `away` from the edge.
TriangleMesh t_junction(double away) {
  TriangleMesh mesh;
  mesh.positions.resize(9, 3);
  mesh.positions << 0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 4, 4, 0, 4, 4, 4, 4, 0, 4, 4, 1, 0,
      4 + away;
  mesh.triangles.resize(13, 3);
  mesh.triangles << 0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4,
      3, 4, 7, 4, 8, 7, 8, 5, 6, 8, 6, 7;
  return mesh;
}

}  // namespace

TEST_CASE("cracks: what rounding alone tears apart becomes one unasked, with copies in its place") {
  const RepairedMesh repaired = repair_mesh(cracked_ball(0x1p-52));
  CHECK(repaired.inspection.is_sphere());
  CHECK(repaired.mesh.vertex_count() == icosphere(3).vertex_count());
  CHECK(repaired.mesh.face_count() == icosphere(3).face_count());
  CHECK(count(repaired, RepairKind::VertexWelded) > 0);
  CHECK(count(repaired, RepairKind::HoleFilled) == 0);
  for (const double gap : {0.0, 0x1p-40})
    CHECK(count(repair_mesh(cracked_ball(gap)), RepairKind::VertexWelded) == 0);
}

TEST_CASE("cracks: a T-junction is closed by splitting the long edge, nothing moves") {
  const TriangleMesh mesh = t_junction(0);
  const RepairedMesh repaired = repair_mesh(mesh);
  CHECK(repaired.inspection.is_sphere());
  CHECK(count(repaired, RepairKind::EdgeSplitAtVertex) == 1);
  CHECK(repaired.actions.size() == 1);
  CHECK(repaired.mesh.positions == mesh.positions);
  CHECK(repaired.mesh.face_count() == mesh.face_count() + 1);
  CHECK(std::count(repaired.face_origin.begin(), repaired.face_origin.end(), 3) == 2);
  CHECK(repaired.inspection.volume == Approx(64));
}

TEST_CASE("cracks: a vertex beside the edge is taken for one on it only when that is asked for") {
  const TriangleMesh mesh = t_junction(0.01);
  CHECK(count(repair_mesh(mesh), RepairKind::EdgeSplitAtVertex) == 0);
  for (const RepairOptions& options :
       {RepairOptions{.weld_length = 0.02}, RepairOptions{.weld_share = 0.02 / 6.9}}) {
    const RepairedMesh repaired = repair_mesh(mesh, options);
    CHECK(repaired.inspection.is_sphere());
    CHECK(count(repaired, RepairKind::EdgeSplitAtVertex) == 1);
    CHECK(count(repaired, RepairKind::HoleFilled) == 0);
  }
  CHECK(count(repair_mesh(mesh, {.weld_length = 0.005}), RepairKind::EdgeSplitAtVertex) == 0);
}

TEST_CASE("cracks: an unused vertex far off makes no length of the box longer") {
  TriangleMesh mesh = t_junction(0.01);
  mesh.positions.conservativeResize(10, 3);
  for (const double far : {100.0, 1e20}) {
    mesh.positions.row(9) << far, 0, 0;
    CHECK(count(repair_mesh(mesh, {.weld_share = 0.005 / 6.9}), RepairKind::EdgeSplitAtVertex) ==
          0);
    CHECK(count(repair_mesh(mesh, {.weld_share = 0.02 / 6.9}), RepairKind::EdgeSplitAtVertex) == 1);
    CHECK(count(repair_mesh(mesh, {.weld_length = 0.02}), RepairKind::EdgeSplitAtVertex) == 1);
  }
}

TEST_CASE("cracks: seams are welded within the tolerance, the lower numbers and places stay") {
  for (const double gap : {0.0, 1e-3}) {
    const TriangleMesh mesh = cracked_ball(gap);
    const RepairedMesh repaired = repair_mesh(mesh, {.weld_length = 2e-3});
    CHECK(repaired.inspection.is_sphere());
    CHECK(count(repaired, RepairKind::VertexWelded) > 20);
    CHECK(count(repaired, RepairKind::HoleFilled) == 0);
    CHECK(repaired.mesh.face_count() == mesh.face_count());
    for (std::size_t v = 0; v < repaired.vertex_origin.size(); ++v)
      CHECK(repaired.mesh.positions.row(static_cast<Eigen::Index>(v)) ==
            mesh.positions.row(repaired.vertex_origin[v]));
  }
  CHECK(count(repair_mesh(cracked_ball(0)), RepairKind::VertexWelded) == 0);
}

TEST_CASE("cracks: a tolerance larger than the faces takes no face's vertices together") {
  const RepairedMesh repaired = repair_mesh(cracked_ball(1e-3), {.weld_length = 10});
  for (Eigen::Index f = 0; f < repaired.mesh.face_count(); ++f) {
    const auto face = repaired.mesh.triangles.row(f);
    CHECK((face[0] != face[1] && face[1] != face[2] && face[2] != face[0]));
  }
}

TEST_CASE("cracks: an edge is split at all vertices on it, in their order") {
  // A face above a segment that n faces below it have vertices on, in shuffled order.
  constexpr int n = 1024;
  TriangleMesh mesh{Points(n + 3, 3), Triangles(n + 1, 3)};
  const auto at = [](int i) { return i == 0 || i == n ? i : 1 + (i * 388 + 5) % (n - 1); };
  for (int i = 0; i <= n; ++i) mesh.positions.row(at(i)) << static_cast<double>(i) / n, 0, 0;
  mesh.positions.row(n + 1) << 0.5, 1, 0;
  mesh.positions.row(n + 2) << 0.5, -1, 0;
  mesh.triangles.row(n) << 0, n, n + 1;
  for (int i = 0; i < n; ++i) mesh.triangles.row(i) << at(i + 1), at(i), n + 2;
  RepairOptions options = RepairOptions::none();
  options.cracks = true;
  const RepairedMesh repaired = repair_mesh(mesh, options);
  CHECK(count(repaired, RepairKind::EdgeSplitAtVertex) == n - 1);
  REQUIRE(repaired.mesh.face_count() == 2 * n);
  for (int i = 0; i < n; ++i)
    CHECK(repaired.mesh.triangles.row(n + i) == Eigen::RowVector3i(at(i), at(i + 1), n + 1));
}

TEST_CASE("cracks: 100,000 loose faces at a hub, and as many beside longer ones, are no matter") {
  constexpr int many = 100000;
  TriangleMesh mesh{Points(3 * many, 3), Triangles(many, 3)};
  std::iota(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size(), 0);
  RepairOptions options = RepairOptions::none();
  options.cracks = true;
  SECTION("at a hub") {
    for (int i = 0; i < many; ++i) {
      const double a = 6.283185307179586 * i / many, b = 6.283185307179586 * (i + 1) / many;
      mesh.positions.row(3 * i) << 0, 0, 1;
      mesh.positions.row(3 * i + 1) << std::cos(a), std::sin(a), 0;
      mesh.positions.row(3 * i + 2) << std::cos(b), std::sin(b), 0;
    }
    CHECK(repair_mesh(mesh, options).actions.empty());
    options.weld_length = 1e-9;
    CHECK(count(repair_mesh(mesh, options), RepairKind::VertexWelded) == 2 * many - 1);
  }
  SECTION("beside longer ones") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < many; ++i) {
      const bool is_long = i % 10 == 0;
      const Vector3 middle = (is_long ? 1 : 1e-3) * Vector3(uniform(random), uniform(random), 0);
      for (int k = 0; k < 3; ++k)
        mesh.positions.row(3 * i + k) =
            middle + (is_long ? 1 : 1e-5) * Vector3(uniform(random), uniform(random), 1);
    }
    options.weld_length = 1e-12;
    CHECK(repair_mesh(mesh, options).actions.empty());
  }
}

TEST_CASE(
    "cracks: a hole without extent is mended as any other, however small it is beside the mesh") {
  TriangleMesh mesh = icosphere(2);
  const Eigen::RowVector3i corners = mesh.triangles.row(0);
  for (const double extent : {0.0, 1e-30, 1e-12}) {
    for (int k = 0; k < 3; ++k)
      mesh.positions.row(corners[k]) << extent * (k == 1), extent * (k == 2), 1;
    TriangleMesh open = mesh;
    open.triangles = mesh.triangles.bottomRows(mesh.face_count() - 1);
    const RepairedMesh repaired = repair_mesh(open);
    CHECK(repaired.inspection.is_sphere());
    CHECK(repaired.inspection.volume > 1);
  }
}

TEST_CASE("repair_mesh: mended once, a mesh is mended, whichever of its parts were wrong") {
  TriangleMesh scan = icosphere(3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  scan.positions(7, 1) = nan;
  scan.triangles.row(40) = scan.triangles.row(41);
  std::swap(scan.triangles(100, 0), scan.triangles(100, 1));
  for (const TriangleMesh& mesh : {scan, t_junction(0), t_junction(0.01), cracked_ball(1e-3)}) {
    const RepairOptions options{.weld_length = 0.02};
    const RepairedMesh once = repair_mesh(mesh, options);
    REQUIRE(once.inspection.is_sphere());
    const RepairedMesh twice = repair_mesh(once.mesh, options);
    CHECK(twice.actions.empty());
    CHECK(twice.mesh.positions == once.mesh.positions);
    CHECK(twice.mesh.triangles == once.mesh.triangles);
  }
}

TEST_CASE("non_finite: vertices without a place go with their faces, and the hole is filled") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = icosphere(2);
    mesh.positions(30, 2) = bad;
    const RepairedMesh repaired = repair_mesh(mesh);
    CHECK(repaired.inspection.is_sphere());
    CHECK(repaired.mesh.positions.allFinite());
    CHECK(count(repaired, RepairKind::NonFiniteVertexDropped) == 1);
    CHECK(count(repaired, RepairKind::NonFiniteFaceRemoved) == 6);
    CHECK(count(repaired, RepairKind::HoleFilled) == 1);
    CHECK(std::find(repaired.vertex_origin.begin(), repaired.vertex_origin.end(), 30) ==
          repaired.vertex_origin.end());
    for (std::size_t v = 0; v < repaired.vertex_origin.size(); ++v)
      if (repaired.vertex_origin[v] >= 0)
        CHECK(repaired.mesh.positions.row(static_cast<Eigen::Index>(v)) ==
              mesh.positions.row(repaired.vertex_origin[v]));
  }
}

TEST_CASE("non_finite: where it is not wanted, and where nothing is left, the mesh says so") {
  TriangleMesh mesh = icosphere(1);
  mesh.positions(3, 0) = std::numeric_limits<double>::quiet_NaN();
  RepairOptions options;
  options.non_finite = false;
  CHECK(repair_mesh(mesh, options).actions.empty());
  mesh.positions.setConstant(std::numeric_limits<double>::quiet_NaN());
  const RepairedMesh nothing = repair_mesh(mesh);
  CHECK(nothing.mesh.vertex_count() == 0);
  CHECK(nothing.mesh.face_count() == 0);
  CHECK_FALSE(nothing.inspection.is_sphere());
}

TEST_CASE("cracks: rows of a pole become one vertex each, and the seam closes") {
  for (const auto& [rows, columns] : {std::pair(7, 12), std::pair(19, 36), std::pair(46, 90)}) {
    RepairOptions options;
    options.weld_share = 1e-7;
    const RepairedMesh repaired = repair_mesh(rows_and_columns(rows, columns), options);
    CHECK(repaired.inspection.is_sphere());
    CHECK(repaired.mesh.vertex_count() == (rows - 2) * columns + 2);
    CHECK(repaired.mesh.face_count() == 2 * (rows - 2) * columns);
    CHECK(count(repaired, RepairKind::InvalidFaceRemoved) == 2 * columns);
    CHECK(repaired.actions.size() == 3);  // these, what was welded, and what nothing uses then
  }
}

TEST_CASE("cracks: a face whose side is no needle's keeps its vertices apart, however far a weld") {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles = Triangles(mesh.triangles.topRows(mesh.face_count() - 1));
  RepairOptions options = RepairOptions::none();
  options.cracks = true;
  options.weld_length = 0.5;  // edges are 0.3 long
  CHECK(count(repair_mesh(mesh, options), RepairKind::VertexWelded) == 0);
}
