#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "reading.h"
#include "sphparam/io/components.h"
#include "sphparam/io/mesh_refusal.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/io/shape_change.h"
#include "support/joined.h"
#include "support/one_sided.h"
#include "support/shaken.h"
#include "support/test_meshes.h"
#include "support/volume_surface.h"
#include "support/without_area.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

MeshSource source_of(const TriangleMesh& mesh, const std::string& path) {
  MeshSource source;
  source.path = path;
  source.file.mesh = mesh;
  source.inspection = inspect_mesh(mesh);
  return source;
}

TriangleMesh open_ball() {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  return mesh;
}

/// Two balls, the second one smaller and beside the first.
TriangleMesh two_balls() {
  TriangleMesh smaller = icosphere(1);
  smaller.positions *= 0.9;
  return joined(icosphere(1), smaller, {3, 0, 0});
}

/// A flat square of two triangles, or of four around its middle: areas without rounding.
TriangleMesh square(double side, bool in_four = false) {
  TriangleMesh mesh;
  mesh.positions = Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = Triangles{{0, 1, 2}, {0, 2, 3}};
  if (in_four) {
    mesh.positions = Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
    mesh.triangles = Triangles{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  }
  mesh.positions *= side;
  return mesh;
}

}  // namespace

TEST_CASE("repair_advice: what would mend a mesh is told as it is typed") {
  const MeshSource source = source_of(open_ball(), "it's a.ply");
  CHECK_THAT(repair_advice(try_repair(source), source.path),
             StartsWith("  --repair would mend it, as in "
                        "`sphparam map 'it'\\''s a.ply' --repair -o mended.sph.ply`:\n    1 hole"));
  CHECK_THAT(repair_advice(try_repair(source), "-a.ply"),
             Contains("`sphparam map ./-a.ply --repair -o mended.sph.ply`"));
}

TEST_CASE("repair_advice: components are listed where one must be chosen") {
  const MeshSource source = source_of(two_balls(), "two.ply");
  const std::string advice = repair_advice(try_repair(source), source.path);
  CHECK_THAT(advice, StartsWith("  --repair keeps one of 2 components") && Contains("\n    2: ") &&
                         Contains("with vertex 42\n") && Contains("--min-kept 0.55 the largest") &&
                         Contains("  --repair --component 1 would mend it, as in `sphparam map "
                                  "two.ply --repair --component 1 -o") &&
                         Contains("    it keeps 55.2 % of the area\n"));
}

TEST_CASE("repair_advice: --all-components is told as map's, and a wrap, which keeps all in one") {
  const MeshSource two = source_of(two_balls(), "two.ply");
  CHECK_THAT(repair_advice(try_repair(two), two.path),
             Contains("\n  --all-components maps each") &&
                 Contains("  `sphparam wrap two.ply -o wrapped.ply` draws one closed surface"));
  CHECK_THAT(repair_advice(try_repair(two), two.path, "sphparam bake two.ply"),
             !Contains("\n  --all-components") &&
                 Contains("`sphparam map two.ply --all-components -o parts.sph.ply` maps each"));
  TriangleMesh many = icosphere(0);
  for (int i = 1; i < 11; ++i) many = joined(many, icosphere(0), {3.0 * i, 0, 0});
  const MeshSource eleven = source_of(many, "many parts.ply");
  CHECK_THAT(repair_advice(try_repair(eleven), eleven.path),
             Contains("  `sphparam wrap 'many parts.ply' -o wrapped.ply` draws one"));
}

TEST_CASE("repair_advice: each component is said to be mapped by what all of them take") {
  const MeshSource two = source_of(two_balls(), "two.ply");
  CHECK(try_parts(two).as_they_are);
  CHECK(try_parts(two).parts == 2);
  const TriangleMesh ring = bumped_torus(8, 20, 0.4, 0, 1);
  const MeshSource ringed = source_of(joined(icosphere(3), ring, {9, 0, 0}), "ringed.ply");
  const PartsTrial parts = try_parts(ringed);
  CHECK_FALSE(parts.as_they_are);
  CHECK(parts.mended == 2);
  CHECK(parts.are_enough());
  REQUIRE(parts.options.longest_handle > RepairOptions{}.longest_handle);
  const std::string each = all_components_line(parts.options);
  CHECK_THAT(each, StartsWith("--repair --all-components --max-handle "));
  CHECK_THAT(repair_advice(try_repair(ringed), ringed.path, "", parts),
             Contains("and\n  " + each + " maps each into a file of its own.\n"));
  for (MeshPart& part : connected_parts(ringed, {}))
    CHECK(repaired(std::move(part.source), parts.options).inspection.is_sphere());
}

TEST_CASE("repair_advice: what no repair maps in its parts is not said to be mapped so") {
  const MeshSource source =
      source_of(joined(icosphere(1), projective_plane(), {4, 0, 0}), "odd.ply");
  const PartsTrial parts = try_parts(source);
  CHECK(parts.mended == 1);
  CHECK_FALSE(parts.are_enough());
  const std::string advice = repair_advice(try_repair(source), source.path, "", parts);
  CHECK_THAT(advice, !Contains("--all-components") && Contains(" the largest.\n"));
  TriangleMesh speck = projective_plane();
  speck.positions *= 1e-3;
  const MeshSource specked = source_of(joined(two_balls(), speck, {0, 4, 0}), "specked.ply");
  CHECK(try_parts(specked).are_enough());
  CHECK_THAT(repair_advice(try_repair(specked), specked.path, "", try_parts(specked)),
             Contains("--repair --all-components maps all but 1 speck, each into a file"));
  const PartsTrial flat =
      try_parts(source_of(joined(two_balls(), collapsed_tetrahedron(), {0, 4, 0}), "flat.ply"));
  CHECK(flat.parts == 3);
  CHECK(flat.mended == 2);  // what is closed but has no area is not mapped
  CHECK(flat.area_share == 1);
  CHECK_FALSE(flat.as_they_are);
  CHECK(flat.are_enough());
}

TEST_CASE(
    "repair_advice: what repair cannot mend, a wrap is told for, unless there is no surface") {
  const MeshSource plane = source_of(projective_plane(), "plane.ply");
  REQUIRE_FALSE(try_repair(plane).can_mend());
  CHECK_THAT(
      repair_advice(try_repair(plane), plane.path),
      Contains("This would remain:\n") && Contains("`sphparam wrap plane.ply -o wrapped.ply`"));
  TriangleMesh nothing = icosphere(1);
  nothing.triangles.resize(0, 3);
  const MeshSource empty = source_of(nothing, "empty.ply");
  CHECK_THAT(repair_advice(try_repair(empty), empty.path), !Contains("wrap"));
  CHECK_THAT(repair_advice(try_repair(source_of(open_ball(), "a.ply")), "a.ply"),
             !Contains("wrap"));
}

TEST_CASE("try_repair: pieces that small errors keep apart are welded, and nothing else is") {
  const MeshSource soup = source_of(shaken_apart(icosphere(3), 1e-5), "soup.ply");
  const RepairTrial trial = try_repair(soup);
  REQUIRE(trial.can_mend());
  CHECK(trial.options.weld_share >= 1e-5);
  CHECK(trial.options.weld_share <= 1e-3);
  CHECK(trial.options.component == 0);
  CHECK_FALSE(trial.mends_unasked());
  CHECK_FALSE(kept_share(trial));
  const MeshSource whole = repaired(soup, trial.options);
  CHECK(whole.file.mesh.vertex_count() == icosphere(3).vertex_count());
  CHECK_THAT(repair_advice(trial, soup.path), StartsWith("  --repair --weld 0.0"));
  // Of one's own: that is what is tried.
  CHECK(try_repair_beyond(soup, {.weld_share = 1e-9}).options.weld_share == 1e-9);
  CHECK(try_repair_beyond(soup, {.component = 2}).options.component == 2);
  for (const auto& mesh : {two_balls(), open_ball(), joined(open_ball(), open_ball(), {3, 0, 0})})
    CHECK(try_repair(source_of(mesh, "a.ply")).options.weld_share < 0);
}

TEST_CASE("try_repair: what the rounding of float32 tears is welded, however few its tears are") {
  const TriangleMesh ball = icosphere(4);
  for (const double share : {0.005, 0.01, 0.05, 0.1, 0.4}) {
    INFO(share);
    const MeshSource torn = source_of(torn_by_rounding(ball, share), "torn.stl");
    const RepairTrial trial = try_repair(torn);
    CHECK_THAT(repair_advice(trial, torn.path), StartsWith("  --repair --weld "));
    CHECK(trial.options.weld_share <= 1e-6);
    CHECK(trial.options.component == 0);
    CHECK_FALSE(trial.mends_unasked());
    CHECK(mends_unasked(torn, trial) == mended(torn, {}).inspection.is_sphere());
    CHECK((share > 0.01 || mends_unasked(torn, trial)));
    const MeshSource whole = repaired(torn, trial.options);
    CHECK(whole.file.mesh.vertex_count() == ball.vertex_count());
    CHECK(whole.added_share == 0);
    CHECK(weld_line(whole).empty());
  }
}

TEST_CASE("repaired: what a weld would have spared is told, and nothing where it spares little") {
  const MeshSource torn = source_of(torn_by_rounding(icosphere(4), 0.005), "torn.stl");
  const MeshSource unasked = repaired(torn, {});
  CHECK(unasked.added_share > 1e-3);
  CHECK_THAT(weld_line(unasked), StartsWith("--repair --weld 2e-05% puts in and drops 0 %"));
  CHECK(weld_line(mended(torn, {})) == weld_line(unasked));
  CHECK(weld_line(repaired(source_of(open_ball(), "a.ply"), {})).empty());
}

namespace {

/// A body on a grid of longitudes and latitudes, with a copy of each pole for each longitude, as
/// archives have them: r cos(π/2) from the axis, which is 1e-16 and not 0.
TriangleMesh with_copies_of_poles(int longitudes) {
  const int parallels = longitudes / 2;
  TriangleMesh mesh;
  mesh.positions.resize((parallels + 1) * longitudes, 3);
  std::vector<std::array<Vertex, 3>> faces;
  for (int i = 0; i <= parallels; ++i) {
    for (int j = 0; j < longitudes; ++j) {
      const double latitude = std::numbers::pi * (double(i) / parallels - 0.5),
                   longitude = 2 * std::numbers::pi * j / longitudes;
      mesh.positions.row(i * longitudes + j) << 100 * std::cos(latitude) * std::cos(longitude),
          100 * std::cos(latitude) * std::sin(longitude), 90 * std::sin(latitude);
      const Vertex a = i * longitudes + j, b = i * longitudes + (j + 1) % longitudes;
      if (i > 0 && i < parallels) faces.push_back({a, b, b + longitudes});
      if (i < parallels - 1) faces.push_back({a, b + longitudes, a + longitudes});
    }
  }
  mesh.triangles.resize(std::ssize(faces), 3);
  for (size_t f = 0; f < faces.size(); ++f)
    mesh.triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  return mesh;
}

}  // namespace

TEST_CASE("try_repair: copies of a pole, apart by rounding, become one unasked") {
  for (const int longitudes : {36, 72}) {
    INFO(longitudes);
    const MeshSource body = source_of(with_copies_of_poles(longitudes), "body.obj");
    REQUIRE(body.inspection.boundary_loops == 2);
    const RepairTrial trial = try_repair(body);
    REQUIRE(trial.can_mend());
    CHECK_THAT(repair_advice(trial, body.path), StartsWith("  --repair would mend it"));
    REQUIRE_FALSE(trial.actions.empty());
    CHECK(trial.actions[0].kind == RepairKind::VertexWelded);
    CHECK(trial.actions[0].count == 2 * (longitudes - 1));
    const MeshSource whole = repaired(body, {});
    CHECK(whole.file.mesh.vertex_count() == longitudes * (longitudes / 2 - 1) + 2);
    CHECK(whole.added_share == 0);
    CHECK(weld_line(whole).empty());
  }
}

TEST_CASE("connected_parts: a cavity is one, and not inside out") {
  TriangleMesh cavity = icosphere(2);
  cavity.positions *= 0.1;
  cavity.triangles.col(1).swap(cavity.triangles.col(2));
  const auto is_inside_out = [](const MeshPart& part) {
    return std::ranges::any_of(part.source.inspection.defects, [](const MeshDefect& defect) {
      return defect.kind == DefectKind::InsideOut;
    });
  };
  for (const double away : {0.0, 3.0}) {
    const std::vector<MeshPart> parts =
        connected_parts(source_of(joined(icosphere(2), cavity, {away, 0, 0}), "two.ply"));
    REQUIRE(parts.size() == 2);
    CHECK_FALSE(parts[0].is_cavity);
    CHECK(parts[1].is_cavity == (away == 0));
    CHECK(is_inside_out(parts[1]) == (away > 0));
  }
}

TEST_CASE("connected_parts: edges are halved in each part, by its own box") {
  const TriangleMesh one = icosphere(1), two = joined(one, one, {5, 0, 0});
  RepairOptions repairs;
  repairs.edge_length = 0.3;
  std::vector<MeshPart> parts = connected_parts(source_of(two, "two.ply"), repairs);
  REQUIRE(parts.size() == 2);
  for (MeshPart& part : parts) {
    CHECK(part.source.repairs.empty());
    CHECK(part.source.file.mesh.face_count() == one.face_count());
    CHECK(repaired_part(std::move(part), repairs).repairs.at(0).kind == RepairKind::EdgeHalved);
  }
}

TEST_CASE("shape_change: what caps add to volume and box is told, against what was there") {
  // Two of its faces the wrong way round, so that the volume of the file is none.
  TriangleMesh ring = bumped_torus(12, 30, 0.3, 0, 1);
  const double volume = inspect_mesh(ring).volume;
  std::swap(ring.triangles(7, 1), ring.triangles(7, 2));
  std::swap(ring.triangles(90, 1), ring.triangles(90, 2));
  const MeshSource mended_ring = repaired(source_of(ring, "ring.ply"), {.longest_handle = 1});
  REQUIRE(mended_ring.handles.size() == 1);
  const std::optional<ShapeChange> change = shape_change(mended_ring);
  REQUIRE(change);
  REQUIRE(change->volume_before);
  CHECK(*change->volume_before == Approx(volume).epsilon(1e-12));
  CHECK(change->volume == mended_ring.inspection.volume);
  CHECK(*change->volume != Approx(volume).epsilon(1e-6));
  CHECK_THAT(shape_line(mended_ring),
             StartsWith("the volume is ") && Contains(" and was ") && Contains(" % "));
  // Over a hole there was no volume, and flat caps leave no box.
  const MeshSource whole = repaired(source_of(open_ball(), "a.ply"), {});
  REQUIRE(shape_change(whole));
  CHECK_FALSE(shape_change(whole)->volume_before);
  CHECK(shape_line(whole).empty());
  CHECK_FALSE(shape_change(source_of(icosphere(1), "a.ply")));
}

TEST_CASE("shape_change: what leaves the bounding box is told by axis") {
  MeshSource raised = repaired(source_of(open_ball(), "a.ply"), {});
  const Face cap = static_cast<Face>(raised.file.mesh.face_count() - 1);
  const Vertex top = static_cast<Vertex>(raised.file.mesh.vertex_count());
  Points& positions = raised.file.mesh.positions;
  positions.conservativeResize(top + 1, 3);
  positions.row(top) << 0, 0, 2;
  raised.file.mesh.triangles(cap, 0) = top;
  Property numbers = *raised.file.find_vertex_property("source_vertex");
  numbers.values.push_back(-1);
  raised.file.set_vertex_property(numbers);
  CHECK(shape_line(raised) ==
        "what was put in leaves the bounding box: z was from -1 to 1 and is from -1 to 2");
}

TEST_CASE("hollow_line: a sheet that is closed back to back encloses nothing, a thin body does") {
  TriangleMesh square;
  square.positions.resize(5, 3);
  square.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 0;
  square.triangles.resize(4, 3);
  square.triangles << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;
  const MeshSource sheet = repaired(source_of(square, "a sheet.stl"), {});
  CHECK(hollow_line(sheet) ==
        "it encloses nothing: two sheets that lie on one another; `sphparam wrap 'a sheet.stl' -o "
        "wrapped.ply` makes a body of it, twice its --distance LENGTH thick");
  TriangleMesh thin = icosphere(2);
  thin.positions.col(2) *= 1e-3;
  CHECK(hollow_line(mended(source_of(thin, "a.ply"), {})).empty());
  CHECK(hollow_line(source_of(open_ball(), "a.ply")).empty());
}

TEST_CASE("refuse: of several components it says what each takes, and of one what it needs") {
  try {
    refuse(source_of(two_balls(), "two.ply"));
  } catch (const PartsRefusal& refusal) {
    CHECK(refusal.parts().parts == 2);
    CHECK_THAT(repair_advice(refusal), Contains("\n  --all-components maps each"));
    CHECK(kept_share(refusal.trial().value()) == Approx(1 / 1.81));
  }
  CHECK_THROWS_AS(refuse(source_of(two_balls(), "two.ply")), PartsRefusal);
  try {
    refuse(source_of(open_ball(), "a.ply"));
  } catch (const MeshRefusal& refusal) {
    CHECK_FALSE(dynamic_cast<const PartsRefusal*>(&refusal));
    CHECK_FALSE(kept_share(refusal.trial().value()));
  }
}

TEST_CASE("repair_advice: what is typed may be a command of one's own") {
  const MeshSource source = source_of(open_ball(), "a.ply");
  CHECK_THAT(repair_advice(try_repair(source), source.path, "mend a.ply"),
             StartsWith("  --repair would mend it, as in `mend a.ply`:\n"));
}

TEST_CASE("try_repair_beyond: the component and the kind of handle that were chosen stay so") {
  const MeshSource balls = source_of(two_balls(), "two.ply");
  CHECK(try_repair_beyond(balls, {.component = 2}).options.component == 2);
  CHECK_THROWS_AS(try_repair_beyond(balls, {.component = 3}), NoSuchComponent);
  const MeshSource ring = source_of(bumped_torus(8, 20, 0.4, 0, 1), "ring.ply");
  const RepairTrial shortest = try_repair(ring);
  const RepairTrial fill = try_repair_beyond(ring, {.handle_choice = HandleChoice::Fill});
  REQUIRE(shortest.can_mend());
  REQUIRE(fill.can_mend());
  CHECK(shortest.handles.at(0).filled == false);
  CHECK(fill.handles.at(0).filled);
  CHECK(fill.options.longest_handle > shortest.options.longest_handle);
}

TEST_CASE("try_repair_unasked: says of unasked repair what the whole trial says") {
  const MeshSource open = source_of(open_ball(), "a.ply");
  CHECK(try_repair_unasked(open).trial.mends_unasked());
  CHECK(mends_unasked(open, try_repair(open)));
  CHECK(try_repair_unasked(open).mended->inspection.is_sphere());
  CHECK(try_repair_unasked(open).trial.actions.size() == try_repair(open).actions.size());
  for (const auto& mesh : {two_balls(), bumped_torus(8, 20, 0.4, 0, 1)}) {
    const MeshSource source = source_of(mesh, "b.ply");
    REQUIRE(try_repair(source).can_mend());
    CHECK_FALSE(try_repair(source).mends_unasked());
    CHECK_FALSE(mends_unasked(source, try_repair(source)));
    CHECK_FALSE(try_repair_unasked(source).trial.mends_unasked());
    CHECK_FALSE(try_repair_unasked(source).trial.can_mend());
    CHECK_FALSE(try_repair_unasked(source).mended);
  }
}

TEST_CASE("repair_advice: a refusal says what was done before") {
  MeshSource source = source_of(open_ball(), "a.ply");
  source.repairs = {{RepairKind::FaceTurned, 1, {4}, "1 face turned over"}};
  CHECK(repair_advice(MeshRefusal(source, std::nullopt)) ==
        "  Done already:\n    1 face turned over\n");
  const std::string advice = repair_advice(MeshRefusal(source, try_repair(source)));
  CHECK_THAT(advice, StartsWith("  --repair would mend it") && Contains("  Done already:\n"));
}

TEST_CASE("connected_parts: what is wrong with one is told by the numbers of the file") {
  TriangleMesh open = open_ball();
  open.positions *= 0.5;
  const Eigen::RowVector3i missing = icosphere(1).triangles.bottomRows<1>().array() + 42;
  const std::vector<MeshPart> parts =
      connected_parts(source_of(joined(icosphere(1), open, {3, 0, 0}), "two.ply"));
  REQUIRE(parts.size() == 2);
  try {
    require_mappable(parts[1].source);
    FAIL("it has a hole");
  } catch (const MeshRefusal& refusal) {
    const std::vector<int>& named = refusal.defects().at(0).elements;
    CHECK(std::set<int>(named.begin(), named.end()) ==
          std::set<int>{missing[0], missing[1], missing[2]});
    CHECK_THAT(refusal.defects().at(0).message, Contains(std::to_string(named[0]) + "-"));
  }
}

TEST_CASE("repaired: what is left is told by the numbers of the file") {
  TriangleMesh mesh = icosphere(1);
  constexpr Vertex lost = 5;
  mesh.positions.row(lost).setConstant(std::numeric_limits<double>::quiet_NaN());
  std::set<int> about;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Eigen::RowVector3i face = mesh.triangles.row(f);
    if ((face.array() == lost).any()) about.insert(face.begin(), face.end());
  }
  about.erase(lost);
  RepairOptions options = RepairOptions::none();
  options.non_finite = true;
  try {
    repaired(source_of(mesh, "a.ply"), options);
    FAIL("it has a hole");
  } catch (const MeshRefusal& refusal) {
    const std::vector<int>& named = refusal.defects().at(0).elements;
    CHECK(std::set<int>(named.begin(), named.end()) == about);
  }
}

TEST_CASE("repaired: triangles of one polygon are one place among those that a repair tells") {
  TriangleMesh cube;
  cube.positions = Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  cube.triangles = Triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                             {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  MeshSource source = source_of(cube, "cube.obj");  // its bottom, two triangles, looks inwards
  source.file.set_face_property(
      {"source_face", ScalarType::Int32, {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}});
  const MeshSource mended = repaired(source, RepairOptions{});
  REQUIRE(mended.repairs.size() == 1);
  CHECK(mended.repairs[0].count == 2);
  CHECK(mended.repairs[0].elements == std::vector<int>{0});
  CHECK(mended.repairs[0].message == "2 faces turned over to run like neighbouring faces: faces 0");
}

TEST_CASE("try_repair: what even repair leaves is told by the numbers of the file") {
  const RepairTrial trial = try_repair(source_of(projective_plane(), "plane.ply"));
  REQUIRE(trial.remaining.size() == 1);
  const MeshDefect& left = trial.remaining[0];
  REQUIRE(left.kind == DefectKind::InconsistentOrientation);
  std::set<std::string> edges;
  for (size_t i = 0; i < left.elements.size(); i += 2) {
    CHECK(left.elements[i] >= 1);
    edges.insert(std::to_string(left.elements[i]) + "-" + std::to_string(left.elements[i + 1]));
  }
  for (const std::string& edge : edges) CHECK_THAT(left.message, Contains(edge));
}

TEST_CASE(
    "connected_parts: the largest is first, of equal ones more faces, then the lowest vertex") {
  constexpr int equal = 30;  // more than a sort that is not stable leaves in place
  TriangleMesh mesh = square(1);
  for (int i = 1; i < equal; ++i) mesh = joined(mesh, square(1), {0, 0, 0});
  mesh = joined(joined(mesh, square(1, true), {0, 0, 0}), square(2), {0, 0, 0});
  mesh.triangles = mesh.triangles.colwise().reverse().eval();  // which is no order of theirs
  const std::vector<MeshPart> parts = connected_parts(source_of(mesh, "squares.ply"));
  std::vector<double> lowest, expected = {4 * equal + 5, 4 * equal};
  for (int i = 0; i < equal; ++i) expected.push_back(4 * i);
  for (const MeshPart& part : parts) {
    const std::vector<double>& vertices =
        values_of(part.source.file.find_vertex_property("source_vertex"));
    lowest.push_back(*std::min_element(vertices.begin(), vertices.end()));
  }
  CHECK(lowest == expected);
  CHECK(parts.at(0).area_share == Approx(4.0 / (equal + 5)));
  CHECK(parts.at(1).area_share == Approx(1.0 / (equal + 5)));
}

TEST_CASE("connected_parts: where nothing has area, shares are of the faces") {
  const TriangleMesh mesh = joined(square(0), square(0, true), {0, 0, 0});
  const std::vector<MeshPart> parts = connected_parts(source_of(mesh, "points.ply"));
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].area_share == Approx(4.0 / 6));
  CHECK(parts[1].area_share == Approx(2.0 / 6));
}
