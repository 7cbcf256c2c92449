#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/balanced_embedding.h"
#include "sphere/face_rays.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/parameterize.h"
#include "support/all_triangulations.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

TriangleMesh some_mesh(int which) {
  switch (which) {
    case 0:
      return tetrahedron();
    case 1:
      return octahedron();
    case 2:
      return icosphere(3);
    case 3:
      return uv_sphere(30, 12);
    case 4:
      return tube(60, 5);
    default:
      return random_sphere_mesh(300, 11);
  }
}

/// Of twelve triangles.
TriangleMesh box(const std::array<double, 3>& sides) {
  TriangleMesh mesh;
  mesh.positions.resize(8, 3);
  for (int v = 0; v < 8; ++v)
    for (int axis = 0; axis < 3; ++axis)
      mesh.positions(v, axis) = sides[static_cast<size_t>(axis)] * ((v >> (2 - axis) & 1) - .5);
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 6, 6, 4, 0, 0, 4, 5, 5, 1, 0, 4, 6, 5, 5, 6, 7, 3, 2, 0, 0, 1, 3, 3, 6, 2,
      7, 6, 3, 1, 5, 3, 3, 5, 7;
  return mesh;
}

std::string names_of_triangle(const TriangleMesh& mesh, Face face) {
  const auto name = [&](int k) { return std::to_string(mesh.triangles(face, k)); };
  return "vertices " + name(0) + ", " + name(1) + " and " + name(2) + ";";
}

}  // namespace

TEST_CASE("parameterize: every method that repairs ends certified, and says which stage made it") {
  const Method method = GENERATE(Method::Progressive, Method::Curvilinear);
  const TriangleMesh mesh = some_mesh(GENERATE(0, 1, 2, 3, 4, 5));
  const Parameterization result = parameterize(mesh, {.method = method});
  CHECK(result.certificate.bijective());
  CHECK_FALSE(result.made_by.empty());
  CHECK(result.certificate.max_length_error < 1e-15);
  // The certificate is of the map returned, not of one before it.
  CHECK(certify(Topology(mesh), result.map).bijective());
}

TEST_CASE(
    "parameterize: protrusions that collapse every linear method are certified by the fallback") {
  const TriangleMesh mesh = tube(400, 4);
  const Parameterization result = parameterize(mesh, {.method = Method::Curvilinear});
  CHECK(result.certificate.bijective());
}

TEST_CASE("parameterize: the paper's method reports its folds and repairs them only when asked") {
  const TriangleMesh mesh = tube(60, 5);
  ParameterizeOptions options{.method = Method::Paper, .measure_stages = true};
  const Parameterization as_printed = parameterize(mesh, options);
  REQUIRE(as_printed.stages.size() > 4);
  CHECK(as_printed.made_by == "smoothing");
  CHECK(as_printed.certificate.fold_count() == as_printed.stages.back().folds);
  CHECK_FALSE(as_printed.certificate.bijective());
  options.repair_paper = true;
  const Parameterization repaired = parameterize(mesh, options);
  CHECK(repaired.certificate.bijective());
  CHECK(repaired.made_by != "smoothing");
  // Of the paper's map nothing is left, which is told.
  CHECK_FALSE(as_printed.made_anew);
  CHECK(repaired.made_anew);
  CHECK(repaired.map.points == parameterize(mesh, ParameterizeOptions{}).map.points);
  CHECK_THAT(repaired.warnings.back(), Catch::Contains("nothing is left of the map"));
}

TEST_CASE("parameterize: given poles lie at plus and minus z") {
  const TriangleMesh mesh = icosphere(3);
  const Method method = GENERATE(Method::Progressive, Method::Curvilinear);
  const Poles poles{17, 400};
  const Parameterization result = parameterize(mesh, {.method = method, .poles = poles});
  REQUIRE(result.certificate.bijective());
  REQUIRE(result.poles);
  CHECK(result.map.point(result.poles->north) == Vector3(0, 0, 1));
  CHECK(result.map.point(result.poles->south) == Vector3(0, 0, -1));
  if (method == Method::Progressive) CHECK(result.poles->north == 17);
}

TEST_CASE("parameterize: given poles are held with given pins, whichever method made the map") {
  const TriangleMesh mesh = icosphere(3);
  const Method method = GENERATE(Method::Progressive, Method::Curvilinear);
  const Poles poles{17, 400};
  const Parameterization result = parameterize(
      mesh, {.method = method, .poles = poles, .pins = {{40, {0.5, 1.0}}, {300, {2.5, 2.0}}}});
  CHECK(result.certificate.bijective());
  CHECK(result.pin_residuals == std::vector<double>{0, 0});
  CHECK(result.map.point(17) == Vector3(0, 0, 1));
  CHECK(result.map.point(400) == Vector3(0, 0, -1));
  REQUIRE(result.poles);
  CHECK(result.poles->north == 17);
  CHECK(result.poles->south == 400);
}

TEST_CASE("parameterize: the paper's smoothing moves given poles, which is told") {
  const TriangleMesh mesh = icosphere(3);
  ParameterizeOptions options{.method = Method::Paper, .poles = Poles{17, 400}};
  const Parameterization moved = parameterize(mesh, options);
  REQUIRE(moved.map.point(17) != Vector3(0, 0, 1));
  REQUIRE(moved.warnings.size() == 1);
  CHECK_THAT(moved.warnings[0], Catch::StartsWith("the paper's smoothing has moved the poles"));
  options.paper.sweeps = 0;
  const Parameterization still = parameterize(mesh, options);
  CHECK(still.map.point(17) == Vector3(0, 0, 1));
  CHECK(still.warnings.empty());
  CHECK(parameterize(mesh, {.method = Method::Paper}).warnings.empty());
}

TEST_CASE(
    "parameterize: pins that fold a triangle are told so, and how far they are from holding") {
  const TriangleMesh mesh = random_sphere_mesh(300, 11);
  ParameterizeOptions options;
  for (int k = 0; k < 3; ++k) {  // clockwise
    options.pins.push_back({mesh.triangles(7, k), {-2.0 * k, 1.0}});
  }
  const Parameterization result = parameterize(mesh, options);
  CHECK(result.certificate.bijective());
  REQUIRE(result.pin_residuals.size() == 3);
  for (const double residual : result.pin_residuals) CHECK(residual > 0);
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].find(names_of_triangle(mesh, 7)) != std::string::npos);
  std::swap(options.pins[0].vertex, options.pins[1].vertex);  // counter-clockwise
  const Parameterization turned = parameterize(mesh, options);
  CHECK(turned.pin_residuals == std::vector<double>{0, 0, 0});
}

TEST_CASE("parameterize: where three pins fold a triangle no other pin is tried, and no pole") {
  const TriangleMesh mesh = random_sphere_mesh(300, 11);
  const Topology topology(mesh);
  ParameterizeOptions options{.automatic_poles = false};
  const Parameterization unpinned = parameterize(mesh, options);
  for (int k = 0; k < 3; ++k) {  // clockwise
    options.pins.push_back({mesh.triangles(7, k), {-2.0 * k, 1.0}});
  }
  std::vector<Vertex> others;  // no two share an edge
  for (Vertex v = 0; others.size() < 3; ++v) {
    if (v == mesh.triangles(7, 0) || v == mesh.triangles(7, 1) || v == mesh.triangles(7, 2))
      continue;
    if (std::ranges::all_of(others, [&](Vertex w) { return topology.find_halfedge(v, w) < 0; })) {
      others.push_back(v);
    }
  }
  size_t pins = 3;
  SECTION("a fourth pin") {
    options.pins.push_back({others[2], {1.0, 2.0}});
    pins = 4;
  }
  SECTION("poles") { options.poles = Poles{others[0], others[1]}; }
  const Parameterization result = parameterize(mesh, options);
  CHECK(result.map.points == unpinned.map.points);
  REQUIRE(result.pin_residuals.size() == pins);
  for (const double residual : result.pin_residuals) CHECK(residual > 0);
  CHECK_FALSE(result.poles);
  CHECK(result.pole_cost == 0);
  REQUIRE(result.warnings.size() == 1);  // nothing is said of poles that could not be moved
  CHECK(result.warnings[0].find(names_of_triangle(mesh, 7)) != std::string::npos);
}

TEST_CASE("parameterize: poles cost next to nothing on limbs too, and what they cost is told") {
  for (const TriangleMesh& mesh :
       {brush(1, 3, 20, 20), brush(1, 3, 5, 20), dumbbell(100, 0.05, 4)}) {
    const Topology topology(mesh);
    for (const auto& [quality, most] : {std::pair{Quality::Normal, 1e-3}, {Quality::Best, 1e-4}}) {
      const auto energy = [&](const Parameterization& result) {
        return distortion_energy(topology, measure_source(mesh), result.map, {});
      };
      const Parameterization map = parameterize(mesh, {.quality = quality});
      const Parameterization free =
          parameterize(mesh, {.automatic_poles = false, .quality = quality});
      REQUIRE(map.poles);
      CHECK(map.certificate.bijective());
      CHECK(map.map.point(map.poles->north) == Vector3::UnitZ());
      CHECK(map.map.point(map.poles->south) == -Vector3::UnitZ());
      CHECK(map.pole_cost < most);
      CHECK(energy(map) / energy(free) - 1 == Approx(map.pole_cost).margin(1e-6));
    }
  }
}

TEST_CASE(
    "parameterize: equal areas stay equal where poles are moved, of boxes of twelve triangles") {
  const std::array<double, 3> sides =
      GENERATE(std::array{1., 1., .1}, std::array{1., 1., 5.}, std::array{1., 1., 2.},
               std::array{1., 2., 3.}, std::array{1., 1., .002});
  const TriangleMesh mesh = box(sides);
  const Parameterization map = parameterize(mesh, {.balance = Balance::EqualArea});
  CHECK(map.certificate.bijective());
  REQUIRE(map.poles);
  CHECK(map.map.point(map.poles->north) == Vector3::UnitZ());
  CHECK(map.map.point(map.poles->south) == -Vector3::UnitZ());
  CHECK(summarise(measure_distortion(mesh, map.map)).weighted_abs_log2_area <= 0.1);
  for (const std::string& warning : map.warnings) CHECK(warning.starts_with("poles raise"));
}

TEST_CASE("parameterize: poles that would keep areas from being equal are left out, and told") {
  TriangleMesh mesh;
  mesh.positions.resize(9, 3);
  mesh.positions << 17.04, 16.96, 3.49, -2.27, -12.21, -2.36, -20.82, 5.64, -3.5, -22.89, 12.76,
      -1.06, -3.15, -22.21, -4.1, 22.63, 13.69, 1.81, -20.74, 13.38, 3.76, 20.54, 13.5, -3.03,
      -2.81, 19.85, -2.86;
  mesh.triangles.resize(14, 3);
  mesh.triangles << 3, 4, 6, 3, 8, 2, 2, 8, 1, 2, 4, 3, 2, 1, 4, 7, 8, 5, 1, 8, 7, 5, 4, 7, 4, 1, 7,
      0, 4, 5, 0, 6, 4, 5, 8, 0, 0, 8, 3, 3, 6, 0;
  const Parameterization map = parameterize(mesh, {.balance = Balance::EqualArea});
  CHECK(map.certificate.bijective());
  CHECK_FALSE(map.poles);
  REQUIRE(map.balance);
  CHECK(map.balance->area_error <= 0.1);
  CHECK(summarise(measure_distortion(mesh, map.map)).weighted_abs_log2_area <= 0.1);
  REQUIRE(map.warnings.size() == 1);
  CHECK(
      map.warnings[0] ==
      "poles would keep areas from being equal: the map has no vertices at ±z, where triangles are "
      "split for textures, no more");
}

TEST_CASE("parameterize: where areas are made even and fillers pressed, poles cost one energy") {
  const TriangleMesh mesh = box({1, 1, .1});
  FillerMarks fillers(12, 0);
  fillers[10] = 1;
  const Parameterization map =
      parameterize(mesh, {.fillers = fillers, .filler_share = 0.02, .balance = Balance::EqualArea});
  CHECK(map.certificate.bijective());
  REQUIRE(map.poles);
  CHECK(std::abs(map.pole_cost) < 100);  // a part of what is 10⁶ times as much is beyond
}

TEST_CASE("parameterize: what poles cost a box of twelve triangles is told") {
  const ParameterizeOptions options{.energy = {.kind = EnergyKind::SymmetricDirichlet}};
  const Parameterization map = parameterize(box({1, 1, .002}), options);
  REQUIRE(map.poles);
  REQUIRE(map.pole_cost > 0.03);
  REQUIRE(map.warnings.size() == 1);
  CHECK(map.warnings[0].starts_with("poles raise the energy by "));
}

TEST_CASE("parameterize: the balance that was found is told, and what falls short of its name") {
  const TriangleMesh protrusion = tube(12, 8);
  CHECK_FALSE(parameterize(protrusion).balance);
  const Parameterization even = parameterize(protrusion, {.balance = Balance::EqualArea});
  REQUIRE(even.balance);
  CHECK(even.balance->moved);
  CHECK(even.balance->lambda > 1);
  const double error = summarise(measure_distortion(protrusion, even.map)).weighted_abs_log2_area;
  CHECK(even.balance->area_error == error);
  CHECK(error <= 0.1);
  CHECK(even.warnings.empty());
  const Parameterization conformal = parameterize(protrusion, {.balance = Balance::Conformal});
  REQUIRE(conformal.balance);
  CHECK(conformal.balance->lambda < 1);
  CHECK(conformal.warnings.empty());

  // Four triangles about a protrusion cannot be as large as the sphere wants them.
  const TriangleMesh thin = tube(400, 4);
  const Parameterization uneven =
      parameterize(thin, {.automatic_poles = false, .balance = Balance::EqualArea});
  REQUIRE(uneven.balance);
  CHECK(uneven.balance->area_error > 0.1);
  REQUIRE(uneven.warnings.size() == 1);
  CHECK(uneven.warnings[0].starts_with("equal-area: the mean |log2 area ratio| is 0."));
}

TEST_CASE("parameterize: a balance that a method does not look for is told") {
  const TriangleMesh mesh = icosphere(2);
  for (const Method method : {Method::Curvilinear, Method::Radial}) {
    const Parameterization result =
        parameterize(mesh, {.method = method, .balance = Balance::EqualArea});
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0] ==
          "equal-area: the map is not balanced: it was made by the " + result.made_by);
  }
}

TEST_CASE("repair_map: the paper's method has one residual a pin, poles or not") {
  const TriangleMesh mesh = icosphere(3);
  SphereMap collapsed{mesh.positions};
  collapsed.points.rowwise() = Vector3(0, 0, 1).transpose();
  const std::vector<Landmark> pins{{40, {0.5, 1.0}}, {300, {2.5, 2.0}}};
  const Parameterization result =
      repair_map(mesh, collapsed, {.method = Method::Paper, .poles = Poles{17, 400}, .pins = pins});
  CHECK(result.made_by == "progressive embedding");
  REQUIRE(result.pin_residuals.size() == pins.size());
  for (size_t i = 0; i < pins.size(); ++i) {
    const Vector3 point = to_cartesian(pins[i].coordinates);
    const double angle = std::acos(point.dot(result.map.point(pins[i].vertex)));
    CHECK(result.pin_residuals[i] == Approx(angle).epsilon(1e-9));
  }
  CHECK_FALSE(result.poles);
  REQUIRE(result.warnings.size() == 3);
  CHECK(result.warnings[2].find("poles") != std::string::npos);
}

TEST_CASE("parameterize: the same bytes for 1, 2 and 4 threads, twice") {
  const Method method = GENERATE(Method::Progressive, Method::Curvilinear, Method::Paper);
  const TriangleMesh mesh = random_sphere_mesh(3000, 5);
  const Points once = parameterize(mesh, {.method = method, .threads = 1}).map.points;
  for (const int threads : {1, 2, 4}) {
    CHECK(parameterize(mesh, {.method = method, .threads = threads}).map.points == once);
  }
}

TEST_CASE("parameterize: the size of the source does not matter, not even at 1e300 and 1e-300") {
  const Method method = GENERATE(Method::Progressive, Method::Curvilinear);
  const TriangleMesh mesh = random_sphere_mesh(400, 3);
  const Points usual = parameterize(mesh, {.method = method}).map.points;
  for (const double scale : {0x1p900, 0x1p-900}) {
    TriangleMesh scaled = mesh;
    scaled.positions *= scale;
    CHECK(parameterize(scaled, {.method = method}).map.points == usual);
  }
}

TEST_CASE("parameterize: coincident and collinear vertices are mapped all the same") {
  const Method method = GENERATE(Method::Progressive, Method::Curvilinear);
  TriangleMesh mesh = icosphere(3);
  SECTION("a third of the vertices on top of a neighbour") {
    const Topology topology(mesh);
    for (Vertex v = 0; v < topology.vertex_count(); v += 3) {
      mesh.positions.row(v) = mesh.positions.row(topology.target(topology.outgoing(v)));
    }
  }
  SECTION("all on a line") { mesh.positions.rightCols(2).setZero(); }
  SECTION("all in one place") { mesh.positions.setZero(); }
  CHECK(parameterize(mesh, {.method = method}).certificate.bijective());
}

TEST_CASE("parameterize: bad meshes and bad poles are refused before any arithmetic") {
  TriangleMesh open = octahedron();
  open.triangles.conservativeResize(7, 3);
  CHECK_THROWS_AS(parameterize(open), MeshError);
  CHECK_THROWS_WITH(parameterize(octahedron(), {.poles = Poles{0, 6}}),
                    "poles.south is 6: it must be a vertex, from 0 to 5");
}

TEST_CASE("parameterize: a cancelled run throws") {
  const ParameterizeOptions options{.progress = [](std::string_view, double) { return false; }};
  CHECK_THROWS_AS(parameterize(icosphere(2), options), Cancelled);
}

TEST_CASE("parameterize: the callback is asked in every stage, by one call at a time, and obeyed") {
  const TriangleMesh mesh = tube(40, 10);  // with protrusions: Newton steps too
  std::atomic<int> inside{0};
  bool ended = false;
  std::vector<std::string> stages;
  const auto ask = [&](std::string_view stage) {
    CHECK(++inside == 1);
    CHECK_FALSE(ended);
    stages.emplace_back(stage);
    --inside;
  };
  parameterize(mesh, {.quality = Quality::Best, .progress = [&](std::string_view stage, double) {
                        ask(stage);
                        return true;
                      }});
  ended = true;
  for (const char* stage : {"hierarchy", "embedding", "certificate", "poles"}) {
    CHECK(std::ranges::count(stages, stage) > 0);
  }
  // Every single one of the questions may be answered with no.
  for (size_t asked = 0; asked < stages.size(); asked += 1 + asked / 8) {
    size_t left = asked;
    const auto progress = [&](std::string_view, double) { return left-- > 0; };
    CHECK_THROWS_AS(parameterize(mesh, {.quality = Quality::Best, .progress = progress}),
                    Cancelled);
  }
}

TEST_CASE("parameterize: every triangulation of the sphere with up to 10 vertices is certified") {
  const Method method = GENERATE(Method::Progressive, Method::Curvilinear);
  long certified = 0, all = 0;
  for (int vertices = 4; vertices <= 10; ++vertices) {
    for (const Rotations& rotations : all_triangulations(vertices)) {
      const TriangleMesh mesh = mesh_of(rotations, 1);
      ++all;
      certified += parameterize(mesh, {.method = method, .threads = 1}).certificate.bijective();
    }
  }
  CHECK(all == 1 + 1 + 2 + 5 + 14 + 50 + 233);
  CHECK(certified == all);
}

TEST_CASE("repair_map: a folded map ends certified, a certified one stays as it is") {
  const TriangleMesh mesh = icosphere(3);
  const ParameterizeOptions options{.automatic_poles = false};
  const SphereMap good = normalised(mesh.positions);
  const Parameterization same = repair_map(mesh, good, options);
  CHECK(same.map.points == good.points);
  CHECK(same.made_by == "given map");

  SphereMap folded = good;  // a vertex beyond its neighbour
  const Vertex v = mesh.triangles(40, 0), neighbour = mesh.triangles(40, 1);
  folded.points.row(v) = (2 * good.point(neighbour) - good.point(v)).normalized();
  const Parameterization mended = repair_map(mesh, folded, options);
  CHECK(mended.certificate.bijective());
  CHECK(mended.made_by == "untangling");

  SphereMap collapsed = good;
  collapsed.points.rowwise() = Vector3(0, 0, 1).transpose();
  CHECK(repair_map(mesh, collapsed, options).made_by == "progressive embedding");
  CHECK_THROWS_AS(repair_map(mesh, {good.points.topRows(5)}, options), std::invalid_argument);
}

TEST_CASE("repair_map: of a frame it makes what is asked for, no poles with a meridian") {
  const TriangleMesh mesh = icosphere(3);
  const SphereMap good = normalised(mesh.positions);
  const Parameterization turned = repair_map(mesh, good, {.meridian = 17});
  CHECK(turned.meridian == 17);
  CHECK(turned.map.point(17).y() == 0);
  CHECK(turned.map.point(17).x() > 0);
  CHECK_FALSE(turned.poles);
  CHECK(turned.map.points.col(2) == good.points.col(2));  // about the axis that it has
}

TEST_CASE("repair_map: the length of the rays does not matter") {
  const TriangleMesh mesh = icosphere(3);
  SphereMap folded = normalised(mesh.positions);
  for (const Face f : {40, 300, 700}) {
    const Vertex v = mesh.triangles(f, 0), neighbour = mesh.triangles(f, 1);
    folded.points.row(v) = 2 * folded.points.row(neighbour) - folded.points.row(v);
  }
  folded = normalised(folded.points);
  const Parameterization mended = repair_map(mesh, normalised(folded.points), {});
  REQUIRE(mended.made_by == "untangling");
  for (const double length : {0x1p-10, 0x1p7, 0x1p900}) {
    const Parameterization result = repair_map(mesh, {length * folded.points});
    CHECK(result.made_by == "untangling");
    CHECK(result.map.points == mended.map.points);
  }
  const ParameterizeOptions with_poles{.poles = Poles{17, 400}};
  const SphereMap good{mesh.positions};
  CHECK(repair_map(mesh, {128 * good.points}, with_poles).pole_cost ==
        repair_map(mesh, normalised(good.points), with_poles).pole_cost);
}

TEST_CASE("parameterize: symmetry does not hold an octahedron above its least energy") {
  const TriangleMesh mesh = octahedron();
  const auto energy = [&](const ParameterizeOptions& options) {
    return distortion_energy(Topology(mesh), measure_source(mesh), parameterize(mesh, options).map,
                             {});
  };
  CHECK(energy({}) == Approx(energy({.poles = Poles{0, 1}})).epsilon(1e-4));
}

TEST_CASE("warn_of_gap: each quality has its own greatest gap") {
  const TriangleMesh mesh = icosphere(1);
  const Topology topology(mesh);
  const auto warns = [&](Quality quality, double gap) {
    const ParameterizeOptions options{.quality = quality};
    MapInProgress work(mesh, topology, options);
    work.result.energy_gap = gap;
    warn_of_gap(work);
    return std::ssize(work.result.warnings);
  };
  const std::vector<std::pair<Quality, double>> greatest{{Quality::Draft, greatest_gap_of_draft},
                                                         {Quality::Normal, greatest_energy_gap},
                                                         {Quality::Best, greatest_gap_of_best}};
  for (const auto& [quality, gap] : greatest) {
    CHECK(warns(quality, gap) == 0);
    CHECK(warns(quality, 1.01 * gap) == 1);
  }
}

TEST_CASE("parameterize: a map that stayed above its least energy says so, others do not") {
  const auto gap_warnings = [](const Parameterization& result) {
    return std::ranges::count_if(result.warnings, [](const std::string& warning) {
      return warning.find("least energy") != std::string::npos;
    });
  };
  const Parameterization ball = parameterize(icosphere(4));
  REQUIRE(ball.energy_gap);
  CHECK(*ball.energy_gap < greatest_energy_gap);
  CHECK(gap_warnings(ball) == 0);
  const auto splintered = [](TriangleMesh mesh) {
    for (const unsigned seed : {1, 2, 3}) mesh = with_slivers(mesh, 0.3, 1e-5, seed);
    return mesh;
  };
  TriangleMesh needle = splintered(icosphere(2));
  needle.positions.col(0) *= 20;
  const Parameterization normal = parameterize(needle);
  CHECK(normal.energy_gap > greatest_energy_gap);
  CHECK(gap_warnings(normal) == 1);
  CHECK_FALSE(parameterize(icosphere(3), {.quality = Quality::Draft}).energy_gap);
  CHECK_FALSE(parameterize(icosphere(3), {.balance = Balance::EqualArea}).energy_gap);
}

TEST_CASE(
    "parameterize: where holes are kept, poles cost what the surface has more of, without "
    "fillers") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  FillerMarks fillers(static_cast<size_t>(mesh.face_count()), 0);
  for (Face f = 0; f < mesh.face_count(); ++f)
    fillers[static_cast<size_t>(f)] = mesh.position(mesh.triangles(f, 0)).z() > 0.5;
  const RestTriangles source = measure_source(mesh);
  const auto energy = [&](const Parameterization& result) {
    double sum = 0;
    for (Face f = 0; f < mesh.face_count(); ++f) {
      const auto i = static_cast<size_t>(f);
      const auto [d, s] = distortion(source[i], face_rays(topology, result.map, f));
      if (!fillers[i]) sum += source[i].area * energy_density({}, d, s);
    }
    return sum;
  };
  const Parameterization free = parameterize(mesh, {.automatic_poles = false, .fillers = fillers});
  const Parameterization chosen = parameterize(mesh, {.fillers = fillers});
  REQUIRE(chosen.poles);
  CHECK(energy(chosen) / energy(free) - 1 == Approx(chosen.pole_cost).margin(1e-9));
  const Parameterization held = parameterize(mesh, {.poles = Poles{0, 40}, .fillers = fillers});
  REQUIRE(held.poles);
  CHECK(energy(held) / energy(free) - 1 == Approx(held.pole_cost).margin(1e-9));
}
