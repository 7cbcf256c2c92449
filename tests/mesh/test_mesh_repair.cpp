#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/mesh/topology.h"
#include "support/joined.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

bool same(const TriangleMesh& a, const TriangleMesh& b) {
  return a.positions == b.positions && a.triangles == b.triangles;
}

const RepairAction* find(const RepairedMesh& repaired, RepairKind kind) {
  for (const RepairAction& action : repaired.actions) {
    if (action.kind == kind) return &action;
  }
  return nullptr;
}

long count(const RepairedMesh& repaired, RepairKind kind) {
  const RepairAction* action = find(repaired, kind);
  return action ? action->count : 0;
}

TriangleMesh moved(TriangleMesh mesh, double x) {
  mesh.positions.col(0).array() += x;
  return mesh;
}

void remove_face(TriangleMesh& mesh, Face f) {
  const Eigen::Index last = mesh.face_count() - 1;
  mesh.triangles.row(f) = mesh.triangles.row(last).eval();
  mesh.triangles.conservativeResize(last, 3);
}

void append_face(TriangleMesh& mesh, Vertex a, Vertex b, Vertex c) {
  mesh.triangles.conservativeResize(mesh.face_count() + 1, 3);
  mesh.triangles.row(mesh.face_count() - 1) << a, b, c;
}

void turn_face(TriangleMesh& mesh, Face f) {
  std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
}

void replace_vertex(TriangleMesh& mesh, Vertex old, Vertex wanted) {
  std::replace(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size(), old, wanted);
}

/// Origins name what is there: positions, and faces up to orientation where nothing else changed.
void check_origins(const TriangleMesh& before, const RepairedMesh& after) {
  REQUIRE(after.vertex_origin.size() == static_cast<size_t>(after.mesh.vertex_count()));
  REQUIRE(after.face_origin.size() == static_cast<size_t>(after.mesh.face_count()));
  REQUIRE(after.corner_origin.size() == static_cast<size_t>(after.mesh.triangles.size()));
  size_t created = 0;
  for (Vertex v = 0; v < after.mesh.vertex_count(); ++v) {
    const Vertex origin = after.vertex_origin[static_cast<size_t>(v)];
    if (origin < 0) {
      CHECK(after.created.at(created++).vertex == v);
      continue;
    }
    CHECK(after.mesh.position(v) == before.position(origin));
  }
  CHECK(created == after.created.size());
  for (const int corner : after.corner_origin) {
    CHECK((corner >= 0 && corner < before.triangles.size()));
  }
}

void check_is_sphere(const RepairedMesh& repaired) {
  CHECK(repaired.inspection.is_sphere());
  CHECK_NOTHROW(require_sphere(repaired.mesh));
}

}  // namespace

TEST_CASE("mesh_repair: a mesh without defects is returned as it is, with its ids") {
  for (const TriangleMesh& mesh : {tetrahedron(), icosphere(2), relabelled(uv_sphere(9, 6), 3)}) {
    const RepairedMesh repaired = repair_mesh(mesh);
    CHECK(same(repaired.mesh, mesh));
    CHECK(repaired.actions.empty());
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
      CHECK(repaired.vertex_origin[static_cast<size_t>(v)] == v);
    }
    for (Face f = 0; f < mesh.face_count(); ++f) {
      CHECK(repaired.face_origin[static_cast<size_t>(f)] == f);
    }
  }
}

TEST_CASE(
    "mesh_repair: random damage to a sphere is mended, twice the same way, and then for good") {
  for (unsigned seed = 1; seed <= 120; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](Eigen::Index n) {
      return static_cast<int>(random() % static_cast<unsigned long>(n));
    };
    TriangleMesh mesh = relabelled(icosphere(2), seed);
    std::string story = "seed " + std::to_string(seed);
    for (int blow = 0; blow < 1 + static_cast<int>(seed % 6); ++blow) {
      const int kind = below(7);
      story += ' ';
      story += "dctuoaw"[kind];
      const Face f = below(mesh.face_count());
      const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
      switch (kind) {
        case 0:
          remove_face(mesh, f);
          break;
        case 1:
          append_face(mesh, b, c, a);
          break;
        case 2:
          turn_face(mesh, f);
          break;
        case 3:
          mesh.positions.conservativeResize(mesh.vertex_count() + 1, 3);
          mesh.positions.bottomRows(1) << 7, 7, 7;
          break;
        case 4:
          mesh = joined(mesh, moved(octahedron(), 5 + blow));
          break;
        case 5:
          append_face(mesh, a, b, a);
          break;
        case 6:
          replace_vertex(mesh, a, mesh.triangles(below(mesh.face_count()), 0));
          break;
      }
    }
    INFO(story);
    const RepairOptions whatever_is_lost{.least_kept = 0};
    const RepairedMesh repaired = repair_mesh(mesh, whatever_is_lost);
    check_is_sphere(repaired);
    check_origins(mesh, repaired);
    CHECK(repaired.inspection.volume > 3);
    CHECK(same(repair_mesh(mesh, whatever_is_lost).mesh, repaired.mesh));
    const RepairedMesh again = repair_mesh(repaired.mesh);
    CHECK(again.actions.empty());
    CHECK(same(again.mesh, repaired.mesh));
  }
}

TEST_CASE("mesh_repair: a copy of a face goes, the first stays") {
  TriangleMesh mesh = icosphere(1);
  append_face(mesh, mesh.triangles(3, 1), mesh.triangles(3, 2), mesh.triangles(3, 0));
  const RepairedMesh repaired = repair_mesh(mesh);
  check_is_sphere(repaired);
  REQUIRE(find(repaired, RepairKind::DuplicateFaceRemoved));
  CHECK(find(repaired, RepairKind::DuplicateFaceRemoved)->elements == std::vector<int>{80});
  CHECK(repaired.mesh.triangles == icosphere(1).triangles);
}

TEST_CASE("mesh_repair: a mesh whose indices count from one is no mesh to mend") {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.array() += 1;
  const RepairedMesh repaired = repair_mesh(mesh);
  CHECK(repaired.actions.empty());
  CHECK(same(repaired.mesh, mesh));
  REQUIRE_FALSE(repaired.inspection.is_sphere());
  CHECK(repaired.inspection.defects.at(0).kind == DefectKind::IndexOutOfRange);
  CHECK(repaired.inspection.defects.at(0).hint == "the indices count from 1: faces - 1");
}

TEST_CASE("mesh_repair: a face of an absent vertex goes and is told as such") {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles(5, 1) = 42;
  CHECK(inspect_mesh(mesh).defects.at(0).message ==
        "1 face names a vertex that does not exist: faces 5");
  const RepairedMesh repaired = repair_mesh(mesh);
  check_is_sphere(repaired);
  REQUIRE(find(repaired, RepairKind::InvalidFaceRemoved));
  CHECK(find(repaired, RepairKind::InvalidFaceRemoved)->message ==
        "1 face removed that named a vertex that does not exist: faces 5");
  mesh.triangles(7, 0) = -1;
  mesh.triangles(9, 0) = mesh.triangles(9, 1);
  CHECK(find(repair_mesh(mesh), RepairKind::InvalidFaceRemoved)->message ==
        "2 faces removed that named vertices that do not exist, 1 that named a vertex twice: "
        "faces 5, 7, 9");
  // Of two reasons the first counts.
  mesh.positions(mesh.triangles(7, 1), 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK(find(repair_mesh(mesh), RepairKind::InvalidFaceRemoved)->message ==
        "1 face removed that named a vertex that does not exist, 1 that named a vertex twice: "
        "faces 5, 9");
}

TEST_CASE("mesh_repair: of two faces back to back on a surface the one that runs with it stays") {
  TriangleMesh mesh = icosphere(1);
  append_face(mesh, mesh.triangles(3, 0), mesh.triangles(3, 1), mesh.triangles(3, 2));
  turn_face(mesh, 3);
  const RepairedMesh repaired = repair_mesh(mesh);
  check_is_sphere(repaired);
  CHECK(find(repaired, RepairKind::DuplicateFaceRemoved)->elements == std::vector<int>{3});
  CHECK(repaired.mesh.face_count() == 80);
}

TEST_CASE(
    "mesh_repair: of a piece that lies back to back the sheet that runs with the surface stays") {
  const TriangleMesh ball = icosphere(3);
  TriangleMesh mesh = ball;
  std::vector<int> added;
  for (Face f = 0; f < ball.face_count(); ++f) {
    const Vector3 middle = ball.position(ball.triangles(f, 0)) +
                           ball.position(ball.triangles(f, 1)) +
                           ball.position(ball.triangles(f, 2));
    if (middle.z() < 1.5) continue;  // a cap
    added.push_back(static_cast<int>(mesh.face_count()));
    append_face(mesh, ball.triangles(f, 0), ball.triangles(f, 2), ball.triangles(f, 1));
  }
  REQUIRE(added.size() > 200);
  RepairOptions options = RepairOptions::none();
  options.duplicates = true;
  const RepairedMesh repaired = repair_mesh(mesh, options);
  CHECK(same(repaired.mesh, ball));
  CHECK(count(repaired, RepairKind::DuplicateFaceRemoved) == std::ssize(added));
  CHECK(find(repaired, RepairKind::DuplicateFaceRemoved)->elements.front() == added.front());
}

TEST_CASE("mesh_repair: turned faces are turned back, an inside-out surface as a whole") {
  TriangleMesh mesh = icosphere(2);
  for (const Face f : {3, 17, 40, 41}) turn_face(mesh, f);
  const RepairedMesh repaired = repair_mesh(mesh);
  CHECK(count(repaired, RepairKind::FaceTurned) == 4);
  CHECK(find(repaired, RepairKind::FaceTurned)->elements == std::vector<int>{3, 17, 40, 41});
  CHECK(repaired.inspection.volume > 0);

  TriangleMesh inside_out = icosphere(2);
  for (Face f = 0; f < inside_out.face_count(); ++f) turn_face(inside_out, f);
  const RepairedMesh turned = repair_mesh(inside_out);
  CHECK(count(turned, RepairKind::TurnedOutward) == 1);
  CHECK(same(turned.mesh, icosphere(2)));
}

TEST_CASE("mesh_repair: a vertex where two fans touch is split") {
  // A sphere pinched at two far vertices that become one.
  TriangleMesh mesh = uv_sphere(8, 7);
  replace_vertex(mesh, static_cast<Vertex>(mesh.vertex_count()) - 1, 0);
  const RepairedMesh repaired = repair_mesh(mesh);
  check_is_sphere(repaired);
  REQUIRE(find(repaired, RepairKind::VertexSplit));
  CHECK(find(repaired, RepairKind::VertexSplit)->elements == std::vector<int>{0});
  CHECK(std::count(repaired.vertex_origin.begin(), repaired.vertex_origin.end(), 0) == 2);
}

TEST_CASE("mesh_repair: bodies that touch along an edge, inside out or not, come apart") {
  for (const bool inside_out : {false, true}) {
    // Two tetrahedra that share the edge 0-1.
    TriangleMesh mesh;
    mesh.positions.resize(6, 3);
    mesh.positions << 0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, -1, 0;
    mesh.triangles.resize(8, 3);
    mesh.triangles << 0, 1, 2, 1, 0, 3, 0, 2, 3, 1, 3, 2, 0, 1, 4, 1, 0, 5, 0, 4, 5, 1, 5, 4;
    for (Face f = 0; f < 8; ++f) {
      if (inside_out != (inspect_mesh(mesh).volume < 0)) turn_face(mesh, f);
    }
    RepairOptions options = RepairOptions::none();
    options.non_manifold = true;
    const RepairedMesh apart = repair_mesh(mesh, options);
    CHECK(apart.inspection.components == 2);
    CHECK(apart.mesh.vertex_count() == 8);
    CHECK(Topology::try_build(apart.mesh.triangles, 8).has_value());
    check_is_sphere(repair_mesh(mesh, {.component = 1}));
  }
}

TEST_CASE("mesh_repair: bodies about an edge come apart however they are turned about it") {
  // Three tetrahedra of the edge 0-1, a quarter of a turn from one another.
  TriangleMesh mesh{Points(8, 3), Triangles(12, 3)};
  mesh.triangles << 0, 1, 2, 1, 0, 3, 0, 2, 3, 1, 3, 2, 0, 1, 4, 1, 0, 5, 0, 4, 5, 1, 5, 4, 0, 1, 6,
      1, 0, 7, 0, 6, 7, 1, 7, 6;
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  mesh.positions.topRows(2) << 0, 0, 0, 0, 0, 1;
  RepairOptions options = RepairOptions::none();
  options.non_manifold = true;
  for (int turn = 0; turn < 32; ++turn) {
    INFO(turn << " of 32");
    for (int corner = 0; corner < 6; ++corner) {
      const double angle = std::acos(-1) * (turn / 16.0 + corner / 2 / 2.0 + corner % 2 / 4.0);
      mesh.positions.row(2 + corner) << std::cos(angle), std::sin(angle), 0;
    }
    const RepairedMesh apart = repair_mesh(mesh, options);
    CHECK(apart.inspection.components == 3);
    CHECK(apart.inspection.volume == Approx(3 * std::sqrt(0.5) / 6));
    CHECK(Topology::try_build(apart.mesh.triangles, 12).has_value());
  }
}

TEST_CASE(
    "mesh_repair: a face that names a vertex twice, where these stay, is none of the surface") {
  RepairOptions options = RepairOptions::none();
  options.non_manifold = true;
  TriangleMesh mesh = octahedron();
  append_face(mesh, 0, 0, 2);
  append_face(mesh, 2, 4, 2);
  const RepairedMesh repaired = repair_mesh(mesh, options);
  CHECK(repaired.actions.empty());
  CHECK(same(repaired.mesh, mesh));
  // Bodies that share an edge come apart all the same.
  mesh.positions.resize(6, 3);
  mesh.positions << 0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, -1, 0;
  mesh.triangles.resize(9, 3);
  mesh.triangles << 0, 1, 0, 0, 1, 2, 1, 0, 3, 0, 2, 3, 1, 3, 2, 0, 1, 4, 1, 0, 5, 0, 4, 5, 1, 5, 4;
  const RepairedMesh apart = repair_mesh(mesh, options);
  CHECK(apart.mesh.vertex_count() == 8);
  CHECK(apart.mesh.triangles.row(0) == mesh.triangles.row(0));
  CHECK(Topology::try_build(apart.mesh.triangles.bottomRows(8), 8).has_value());
}

TEST_CASE("mesh_repair: two bodies with a common wall come apart, each with its own") {
  // Octahedra above and below the wall 0 1 2, each closed by it.
  TriangleMesh mesh;
  mesh.positions.resize(5, 3);
  mesh.positions << 1, 0, 0, -1, 1, 0, -1, -1, 0, 0, 0, 1, 0, 0, -1;
  mesh.triangles.resize(8, 3);
  mesh.triangles << 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1, 1, 0, 4, 2, 1, 4, 0, 2, 4, 0, 1, 2;
  RepairOptions options = RepairOptions::none();
  options.duplicates = options.non_manifold = true;
  const RepairedMesh apart = repair_mesh(mesh, options);
  CHECK(apart.inspection.components == 2);
  CHECK(apart.inspection.boundary_loops == 0);
  CHECK(apart.mesh.vertex_count() == 8);
}

TEST_CASE("mesh_repair: an inner wall goes, the surface about it stays") {
  TriangleMesh mesh = octahedron();
  append_face(mesh, 0, 2, 1);  // across the middle: edges 0-2 and 2-1 have three faces
  append_face(mesh, 0, 1, 3);
  const RepairedMesh repaired = repair_mesh(mesh, {.component = 1});
  check_is_sphere(repaired);
  CHECK(repaired.mesh.face_count() == 8);
  CHECK(repaired.inspection.volume == Approx(inspect_mesh(octahedron()).volume));
}

TEST_CASE("mesh_repair: a vertex of valence two keeps its place, the other diagonal mends it") {
  // Face 0 of an icosahedron's edge a-b opened to the flap a v b, v b a.
  TriangleMesh mesh = icosphere(1);
  const Vertex a = mesh.triangles(0, 0), b = mesh.triangles(0, 1), v = 42;
  mesh.positions.conservativeResize(43, 3);
  mesh.positions.row(v) = (0.5 * (mesh.positions.row(a) + mesh.positions.row(b))).eval();
  append_face(mesh, a, v, b);
  append_face(mesh, b, v, a);
  REQUIRE_FALSE(inspect_mesh(mesh).is_sphere());
  const RepairedMesh repaired = repair_mesh(mesh);
  check_is_sphere(repaired);
  CHECK(count(repaired, RepairKind::DiagonalTurned) == 1);
  CHECK(repaired.mesh.vertex_count() == 43);
  CHECK(repaired.mesh.face_count() == 82);
}

TEST_CASE(
    "mesh_repair: of two diagonals that would mend a flap a short one that folds is not taken") {
  // Faces 0 1 2 and 1 0 3 in a plane over a cone, between them the flap to vertex 5.
  TriangleMesh mesh{Points(6, 3), Triangles(8, 3)};
  mesh.triangles << 0, 1, 2, 1, 0, 3, 2, 1, 4, 0, 2, 4, 3, 0, 4, 1, 3, 4, 1, 0, 5, 0, 1, 5;
  RepairOptions options = RepairOptions::none();
  options.non_manifold = true;
  const auto ends_of_new_edge = [&] {
    const RepairedMesh repaired = repair_mesh(mesh, options);
    check_is_sphere(repaired);
    CHECK(count(repaired, RepairKind::DiagonalTurned) == 1);
    const Topology topology(repaired.mesh);
    return std::array{topology.find_halfedge(2, 5) >= 0, topology.find_halfedge(3, 5) >= 0};
  };
  mesh.positions << -1, 0, 0, 1, 0, 0, 0, 2, 0, 1.6, -0.5, 0, 0, 40, -10, 0.6, -0.4, 0;
  CHECK(ends_of_new_edge() == std::array{true, false});
  // One that makes a face without area folds nothing.
  mesh.positions << -1, 0, 0, 1, 0, 0, 0, 2, 0, -6, -9, 0, 0, 7, -4, -1.25, -0.5, 0;
  CHECK(ends_of_new_edge() == std::array{true, false});
}

TEST_CASE("mesh_repair: the component that is asked for is kept") {
  const TriangleMesh mesh = joined(joined(octahedron(), icosphere(1)), moved(tetrahedron(), 9));
  std::vector<Eigen::Index> faces;
  for (const int component : {1, 2, 3}) {
    const RepairedMesh repaired = repair_mesh(mesh, {.component = component});
    check_is_sphere(repaired);
    CHECK(count(repaired, RepairKind::ComponentDropped) == 2);
    const SurfacePart& part = repaired.parts.largest.at(static_cast<size_t>(component - 1));
    CHECK(part.faces == repaired.mesh.face_count());
    CHECK(part.area_share == Approx(repaired.inspection.area / inspect_mesh(mesh).area));
    CHECK(repaired.parts.area_share == part.area_share);
    CHECK(repaired.parts.face_share == Approx(static_cast<double>(part.faces) / 92));
    faces.push_back(repaired.mesh.face_count());
  }
  CHECK(faces == std::vector<Eigen::Index>{4, 80, 8});  // by area
  CHECK_THROWS_AS(repair_mesh(mesh, {.component = 4}), NoSuchComponent);
  CHECK_THROWS_AS(repair_mesh(icosphere(1), {.component = 2}), NoSuchComponent);
}

TEST_CASE("mesh_repair: the largest component has the most area, not the most faces") {
  TriangleMesh handle = icosphere(3);
  handle.positions *= 0.1;
  const TriangleMesh mug = icosphere(1), both = joined(handle, moved(mug, 5));
  REQUIRE(handle.face_count() > mug.face_count());
  const RepairedMesh repaired = repair_mesh(both);  // the handle has 1.1 % of the area
  check_is_sphere(repaired);
  CHECK(repaired.mesh.face_count() == mug.face_count());
  CHECK(repaired.parts.count == 2);
  CHECK(repaired.parts.area_share == Approx(inspect_mesh(mug).area / inspect_mesh(both).area));
  CHECK(repair_mesh(both, {.component = 2}).mesh.face_count() == handle.face_count());
  CHECK_THAT(inspect_mesh(both).defects.front().message,
             Catch::Contains("the largest has 80 faces and 98.9 % of the area"));
}

TEST_CASE(
    "mesh_repair: what cannot be made whole is left when that is known, where only that counts") {
  TriangleMesh open = icosphere(2);
  open.triangles = Triangles(open.triangles.bottomRows(open.triangles.rows() - 1));
  const TriangleMesh two = joined(open, moved(open, 5));
  CHECK(count(repair_mesh(two), RepairKind::HoleFilled) == 2);
  const RepairedMesh left = repair_mesh(two, {.only_whole = true});
  CHECK(left.parts.refused);
  CHECK(count(left, RepairKind::HoleFilled) == 0);
  CHECK_FALSE(left.inspection.is_sphere());
  check_is_sphere(repair_mesh(open, {.only_whole = true}));
}

TEST_CASE("mesh_repair: what would cost more than specks is not dropped unless it is asked for") {
  const TriangleMesh two = joined(icosphere(2), moved(icosphere(2), 5));
  const RepairedMesh refused = repair_mesh(two);
  CHECK_FALSE(refused.inspection.is_sphere());
  CHECK(refused.mesh.face_count() == two.face_count());
  CHECK(count(refused, RepairKind::ComponentDropped) == 0);
  CHECK(refused.parts.refused);
  REQUIRE(refused.parts.largest.size() == 2);
  CHECK(refused.parts.largest[0].vertex == 0);  // of equal ones that with the lowest vertex
  CHECK(refused.parts.largest[1].area_share == Approx(0.5));
  CHECK(repair_mesh(two, {.least_kept = 0.6}).parts.refused);
  for (const RepairOptions& asked :
       {RepairOptions{.least_kept = 0.4}, RepairOptions{.component = 1}}) {
    const RepairedMesh kept = repair_mesh(two, asked);
    check_is_sphere(kept);
    CHECK_FALSE(kept.parts.refused);
    CHECK(kept.vertex_origin.front() == 0);
    CHECK(kept.parts.area_share == Approx(0.5));
  }
  const RepairedMesh whole = repair_mesh(icosphere(2));
  CHECK(whole.parts.count == 0);
  CHECK(whole.parts.area_share == 1);
}

TEST_CASE("mesh_repair: components without any area go by their faces") {
  TriangleMesh flat = joined(octahedron(), icosphere(1));
  flat.positions.setZero();
  const RepairedMesh repaired = repair_mesh(flat, {.least_kept = 0.9});
  check_is_sphere(repaired);
  CHECK(repaired.parts.area_share == Approx(80.0 / 88));
}

TEST_CASE("mesh_repair: holes up to the limit are filled, larger ones are not") {
  TriangleMesh mesh = uv_sphere(12, 5);
  for (Face f = static_cast<Face>(mesh.face_count()) - 1; f >= 0; --f) {
    if ((mesh.triangles.row(f).array() == 0).any()) remove_face(mesh, f);
  }
  const RepairedMesh open = repair_mesh(mesh, {.largest_hole = 11});
  CHECK_FALSE(open.inspection.is_sphere());
  CHECK(open.largest_hole_left == 12);
  const RepairedMesh filled = repair_mesh(mesh, {.largest_hole = 12});
  check_is_sphere(filled);
  CHECK(count(filled, RepairKind::HoleFilled) == 1);
  CHECK(filled.largest_hole_left == 0);
  CHECK(filled.created.empty());
  CHECK(filled.inspection.volume > 0.9 * inspect_mesh(uv_sphere(12, 5)).volume);
}

TEST_CASE("mesh_repair: where every cut would double an edge a vertex is created") {
  TriangleMesh one_face = tetrahedron();
  one_face.triangles.conservativeResize(1, 3);
  const RepairedMesh repaired = repair_mesh(one_face);
  check_is_sphere(repaired);
  REQUIRE(repaired.created.size() == 1);
  CHECK(repaired.created[0].mean_of.size() == 3);

  // The torus of seven vertices, each joined to each other, without one of them.
  TriangleMesh torus;
  torus.positions = Points::Random(7, 3);
  torus.triangles.resize(14, 3);
  for (int i = 0; i < 7; ++i) {
    torus.triangles.row(2 * i) << i, (i + 1) % 7, (i + 3) % 7;
    torus.triangles.row(2 * i + 1) << i, (i + 3) % 7, (i + 2) % 7;
  }
  REQUIRE(inspect_mesh(torus).genus == 1);
  for (Face f = 13; f >= 0; --f) {
    if ((torus.triangles.row(f).array() == 0).any()) remove_face(torus, f);
  }
  REQUIRE(torus.face_count() == 8);
  const RepairedMesh closed = repair_mesh(torus);
  REQUIRE(closed.created.size() == 1);
  CHECK(closed.created[0].mean_of.size() == 6);
  CHECK(closed.mesh.face_count() == 14);
  CHECK(closed.inspection.genus == 1);
}

TEST_CASE("mesh_repair: faces without area go where the surface stays a sphere") {
  TriangleMesh mesh = icosphere(2);
  SECTION("a vertex on another is merged") {
    const Vertex a = mesh.triangles(0, 0), b = mesh.triangles(0, 1);
    mesh.positions.row(b) = mesh.positions.row(a).eval();
    const RepairedMesh repaired = repair_mesh(mesh);
    check_is_sphere(repaired);
    CHECK(count(repaired, RepairKind::FlatFaceCollapsed) == 1);
    CHECK(repaired.inspection.defects.empty());
    check_origins(mesh, repaired);
  }
  SECTION("a vertex on the opposite edge gets that edge turned to it") {
    const Vertex a = mesh.triangles(0, 0), b = mesh.triangles(0, 1), c = mesh.triangles(0, 2);
    mesh.positions.row(c) = (0.5 * (mesh.positions.row(a) + mesh.positions.row(b))).eval();
    const RepairedMesh repaired = repair_mesh(mesh);
    check_is_sphere(repaired);
    CHECK(repaired.mesh.vertex_count() == mesh.vertex_count());
    CHECK(count(repaired, RepairKind::FlatFaceTurned) == 1);
    CHECK(repaired.inspection.defects.empty());
  }
  SECTION("all in one place, or on a line: no face is worth more than another, so all stay") {
    const bool on_a_line = GENERATE(false, true);
    mesh.positions.rightCols(2).setZero();
    if (!on_a_line) mesh.positions.setZero();
    const RepairedMesh repaired = repair_mesh(mesh);
    check_is_sphere(repaired);
    CHECK(repaired.actions.empty());
    CHECK(repaired.mesh.triangles == mesh.triangles);
  }
}

TEST_CASE("mesh_repair: faces without area are found and mended however small beside the mesh") {
  TriangleMesh mesh = icosphere(4);
  for (double& x : mesh.positions.reshaped()) x = 2 * std::round(500 * x);  // sums and halves exact
  const Eigen::Index vertices = mesh.vertex_count(), faces = mesh.face_count();
  constexpr int added = 400;
  mesh.positions.conservativeResize(vertices + added, 3);
  mesh.triangles.conservativeResize(faces + 2 * added, 3);
  for (int i = 0; i < added; ++i) {  // a vertex on a side that only one of its two faces knows
    const Eigen::RowVector3i corners = mesh.triangles.row(3 * i);
    const auto middle = static_cast<Vertex>(vertices + i);
    mesh.positions.row(middle) =
        (mesh.positions.row(corners[0]) + mesh.positions.row(corners[1])) / 2;
    mesh.triangles.row(3 * i) << corners[0], middle, corners[2];
    mesh.triangles.row(faces + 2 * i) << middle, corners[1], corners[2];
    mesh.triangles.row(faces + 2 * i + 1) << corners[0], corners[1], middle;
  }
  const double area = inspect_mesh(mesh).area;
  for (const double far : {1.0, 1e3, 1e9}) {  // one vertex, which makes the box larger
    TriangleMesh spiked = mesh;
    const Vertex spike = mesh.triangles(faces - 1, 0);
    spiked.positions.row(spike) *= far;
    const MeshInspection inspection = inspect_mesh(spiked);
    const auto flat = std::ranges::find(inspection.defects, DefectKind::ZeroAreaFace,
                                        [](const MeshDefect& defect) { return defect.kind; });
    REQUIRE(flat != inspection.defects.end());
    CHECK(flat->count == added);
    CHECK(inspection.area >= area);
    CHECK(repair_mesh(spiked).inspection.defects.empty());
  }
}

TEST_CASE("mesh_repair: a copy that was made and merged again is no vertex that is dropped") {
  TriangleMesh mesh = icosphere(2);
  std::vector<Face> about;  // a vertex, which joins two fans where two faces across it are gone
  for (Face f = 0; f < mesh.face_count(); ++f)
    if ((mesh.triangles.row(f).array() == 20).any()) about.push_back(f);
  const auto share_an_edge = [&](Face a, Face b) {
    int shared = 0;
    for (int k = 0; k < 3; ++k)
      shared += (mesh.triangles.row(b).array() == mesh.triangles(a, k)).any();
    return shared > 1;
  };
  const Face first = about[0];
  const Face second = *std::find_if(about.begin() + 1, about.end(),
                                    [&](Face f) { return !share_an_edge(first, f); });
  remove_face(mesh, std::max(first, second));
  remove_face(mesh, std::min(first, second));
  const RepairedMesh repaired = repair_mesh(mesh);
  check_is_sphere(repaired);
  CHECK(find(repaired, RepairKind::VertexSplit)->elements == std::vector<int>{20});
  CHECK(find(repaired, RepairKind::FlatFaceCollapsed)->elements == std::vector<int>{20});
  CHECK(count(repaired, RepairKind::UnusedVertexDropped) == 0);
  const std::set<Vertex> kept(repaired.vertex_origin.begin(), repaired.vertex_origin.end());
  CHECK(repaired.mesh.vertex_count() == mesh.vertex_count());
  CHECK(std::ssize(kept) == mesh.vertex_count());
}

TEST_CASE("mesh_repair: what only one repair mends, no other touches") {
  TriangleMesh mesh = joined(icosphere(1), moved(octahedron(), 5));
  turn_face(mesh, 3);
  remove_face(mesh, 10);
  RepairOptions options = RepairOptions::none();
  CHECK(repair_mesh(mesh, options).actions.empty());
  options.orientation = true;
  const RepairedMesh oriented = repair_mesh(mesh, options);
  REQUIRE(oriented.actions.size() == 1);
  CHECK(oriented.actions[0].kind == RepairKind::FaceTurned);
  options = RepairOptions::none();
  options.holes = true;
  options.components = true;
  CHECK(count(repair_mesh(mesh, options), RepairKind::FaceTurned) == 0);
}

TEST_CASE("mesh_repair: what has handles, one side or no numbers stays refused") {
  // A torus of 7 × 7 quads.
  const int n = 7;
  TriangleMesh torus;
  torus.positions = Points::Random(n * n, 3);
  torus.triangles.resize(2 * n * n, 3);
  const auto at = [](int i, int j) { return (i % n) * n + j % n; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      torus.triangles.row(2 * at(i, j)) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      torus.triangles.row(2 * at(i, j) + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  const RepairedMesh repaired = repair_mesh(torus);
  REQUIRE_FALSE(repaired.inspection.is_sphere());
  CHECK(repaired.inspection.defects[0].kind == DefectKind::WrongGenus);
  remove_face(torus, 5);
  CHECK(repair_mesh(torus).inspection.genus == 1);

  TriangleMesh moebius;
  moebius.positions = Points::Random(5, 3);
  moebius.triangles.resize(5, 3);
  moebius.triangles << 0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 0, 4, 0, 1;
  const MeshInspection one_sided = repair_mesh(moebius).inspection;
  CHECK_FALSE(one_sided.is_sphere());
  const auto says_so = [](const MeshDefect& defect) {
    return defect.message.find("one-sided") != std::string::npos;
  };
  CHECK(std::ranges::any_of(one_sided.defects, says_so));
  TriangleMesh turned = icosphere(1);  // two-sided, with a face turned over
  turn_face(turned, 3);
  CHECK(std::ranges::none_of(inspect_mesh(turned).defects, says_so));

  TriangleMesh not_finite = icosphere(1);
  not_finite.positions(3, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(repair_mesh(not_finite, {.non_finite = false}).actions.empty());
}

TEST_CASE("mesh_repair: what a repair has made itself is not named by numbers nobody has") {
  RepairAction action = {RepairKind::FlatFaceTurned, 2, {-1, -1}, {}};
  CHECK_THAT(describe(action), Catch::EndsWith(": 2 made by this repair"));
  action = {RepairKind::FlatFaceTurned, 3, {4, -1, 7}, {}};
  CHECK_THAT(describe(action), Catch::EndsWith(": faces 4, 7 and 1 made by this repair"));
  action = {RepairKind::EdgeSplit, 2, {4, -1, 7, 8}, {}};
  CHECK_THAT(describe(action), Catch::EndsWith("between vertices 7-8 and 1 made by this repair"));
}

TEST_CASE("mesh_repair: random faces over few vertices never crash and never claim too much") {
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    const int vertices = 4 + static_cast<int>(random() % 8),
              faces = 4 + static_cast<int>(random() % 30);
    TriangleMesh mesh;
    mesh.positions.resize(vertices, 3);
    for (double& x : mesh.positions.reshaped()) x = static_cast<double>(random() % 5);
    mesh.triangles.resize(faces, 3);
    for (int& v : mesh.triangles.reshaped()) {
      v = static_cast<int>(random() % static_cast<unsigned long>(vertices + (seed % 3 == 0)));
    }
    INFO("seed " << seed);
    const RepairedMesh repaired = repair_mesh(mesh);
    check_origins(mesh, repaired);
    CHECK(repaired.inspection.is_sphere() == inspect_mesh(repaired.mesh).is_sphere());
    if (repaired.inspection.is_sphere()) CHECK_NOTHROW(require_sphere(repaired.mesh));
  }
}

TEST_CASE("mesh_repair: hubs of valence 100,000 and holes of 100,000 edges are no matter") {
  const int many = 100000;
  TriangleMesh hubs = uv_sphere(many, 1);
  SECTION("a flat face at the hub, many of them") {
    for (int i = 0; i < many; i += 2) hubs.positions.row(1 + i) = hubs.positions.row(0).eval();
    check_is_sphere(repair_mesh(hubs));
  }
  SECTION("many faces turned, copied, back to back") {
    for (Face f = 0; f < many; f += 3) turn_face(hubs, f);
    const Eigen::Index faces = hubs.face_count();
    hubs.triangles.conservativeResize(2 * faces, 3);
    hubs.triangles.bottomRows(faces) = hubs.triangles.topRows(faces).eval();
    check_is_sphere(repair_mesh(hubs));
  }
  SECTION("a hole as large as the rim") {
    TriangleMesh open = hubs;
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < hubs.face_count(); ++f) {
      if ((hubs.triangles.row(f).array() != 0).all())
        open.triangles.row(kept++) = hubs.triangles.row(f);
    }
    open.triangles.conservativeResize(kept, 3);
    CHECK_FALSE(repair_mesh(open).inspection.is_sphere());
    check_is_sphere(repair_mesh(open, {.largest_hole = many}));
  }
  SECTION("an edge with 100,000 faces") {
    TriangleMesh book;
    book.positions = Points::Random(many + 2, 3);
    book.triangles.resize(2 * many, 3);
    for (int i = 0; i < many; ++i) {
      book.triangles.row(2 * i) << 0, 1, 2 + i;
      book.triangles.row(2 * i + 1) << 1, 0, 2 + i;
    }
    const RepairedMesh repaired = repair_mesh(book);
    CHECK(repaired.inspection.is_sphere() == inspect_mesh(repaired.mesh).is_sphere());
  }
}
