#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "records/comparison_record.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/records/bake_record.h"
#include "sphparam/records/distance_record.h"
#include "sphparam/records/export_record.h"
#include "sphparam/records/harmonics_record.h"
#include "sphparam/records/inspection_record.h"
#include "sphparam/records/map_record.h"
#include "sphparam/records/remesh_record.h"
#include "sphparam/records/verification_record.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Json = nlohmann::ordered_json;

namespace {

MeshSource source_of(const TriangleMesh& mesh, const std::string& path = "folder/ball.ply") {
  MeshSource source;
  source.path = path;
  source.file.mesh = mesh;
  source.file.format = "PLY";
  source.inspection = inspect_mesh(mesh);
  return source;
}

MappedMesh ball(int level = 2) {
  const TriangleMesh mesh = icosphere(level);
  return mapped(mesh, {mesh.positions});
}

/// Keys in their order, with commas between.
std::string keys_of(const Json& json) {
  std::string keys;
  for (const auto& [key, value] : json.items()) keys += (keys.empty() ? "" : ",") + key;
  return keys;
}

/// How many lines there are; every one has its end.
long line_count(const std::string& text) {
  REQUIRE(text.ends_with("\n"));
  return std::count(text.begin(), text.end(), '\n');
}

}  // namespace

TEST_CASE("map_record: what was asked for, what came out, by the numbers of the file") {
  MeshSource source = source_of(icosphere(2));
  std::vector<double> numbers;
  for (Vertex v = 0; v < source.file.mesh.vertex_count(); ++v) numbers.push_back(v + 1000.0);
  source.file.set_vertex_property({"source_vertex", ScalarType::Int32, numbers});
  ParameterizeOptions options;
  const Parameterization result = parameterize(source.file.mesh, options);
  options.poles = Poles{1003, 1005};
  const Json json = Json::parse(
      to_json(MapRecord{.source = source,
                        .options = options,
                        .result = result,
                        .repairs = {.holes = false},
                        .pins = {{7, {.theta = 0.5, .phi = 1.5}}},
                        .distortion = summarise(measure_distortion(source.file.mesh, result.map)),
                        .chart = report_chart(source.file.mesh, result.map, 0),
                        .outputs = {{"map", "ball.sph.ply"}},
                        .seconds = 1.5}));
  CHECK(keys_of(json) ==
        "sphparam,command,input,inspection,repairs,handles,added,components,options,account,like,"
        "stages,"
        "made_by,made_anew,poles,meridian,radial,alignment,pole_residuals,pins,lambda,"
        "filler_share,balance,energy,energy_gap,energy_cost,certificate,"
        "distortion,chart,outputs,warnings,notes,seconds");
  REQUIRE(result.energy_gap);
  CHECK(json["energy_gap"] == *result.energy_gap);
  CHECK(json["input"]["file"] == "folder/ball.ply");
  CHECK(json["inspection"]["mappable"] == true);
  CHECK(json["options"]["method"] == "progressive");
  CHECK(json["options"]["poles"]["north"] == 1003);
  CHECK(json["options"]["repair"] ==
        Json({"non-finite", "duplicates", "cracks", "orientation", "non-manifold", "components",
              "handles", "flat-faces", "unused"}));
  CHECK(json["account"].is_null());
  CHECK(json["like"].is_null());
  CHECK(json["added"] == 0);
  CHECK(json["made_anew"] == false);
  CHECK(json["stages"].size() == result.stages.size());
  REQUIRE(result.poles);
  CHECK(json["poles"]["north"] == result.poles->north + 1000);
  CHECK(json["pins"][0] ==
        Json({{"vertex", 1007}, {"theta", 0.5}, {"phi", 1.5}, {"residual", nullptr}}));
  CHECK(json["certificate"]["one_to_one"] == true);
  CHECK(json["certificate"]["covering"] == result.certificate.covering);
  CHECK(json["chart"]["certified"] == true);
  CHECK(json["outputs"]["map"] == "ball.sph.ply");
  CHECK(json["seconds"] == 1.5);
}

TEST_CASE("map_record: the input is what was read, and a shape inside out is warned of") {
  TriangleMesh mesh = octahedron();
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  MeshSource source = source_of(mesh);
  source.file.comments = {"by hand", "source_vertices 7"};
  source.file.set_vertex_property({"source_vertex", ScalarType::Int32, {0, 1, 2, 3, 4, 6}});
  const std::vector<double> of_faces(8, 1);
  for (const char* name : {"source_face", "corner_red_0", "label"})
    source.file.set_face_property({name, ScalarType::Int32, of_faces});
  const InputNames names = input_names(source.file);
  source.file = attach_map(std::move(source.file), {mesh.positions}, {{"method", "none"}});
  const ParameterizeOptions options;
  Parameterization result;
  result.warnings = {"another"};
  result.made_anew = true;
  const MapRecord record{.source = source, .options = options, .result = result, .input = names};
  const Json json = Json::parse(to_json(record));
  CHECK(json["input"]["vertex_properties"].empty());
  CHECK(json["input"]["face_properties"] == Json({"label"}));
  CHECK(json["input"]["comments"] == Json({"by hand"}));
  CHECK(json["made_anew"] == true);
  REQUIRE(json["warnings"].size() == 2);
  CHECK(json["warnings"][0] ==
        "inside out: the volume is negative, and the map a mirror image of the body: "
        "--repair=orientation turns it");
  CHECK(json["warnings"][1] == "another");
  mark_fillers(source.file, {1, 1, 1, 0, 0, 0, 0, 0});
  CHECK(shape_warnings(source).size() == 1);
  mark_fillers(source.file, {1, 1, 1, 1, 0, 0, 0, 0});  // a sheet: no side of it is out
  CHECK(shape_warnings(source).empty());
}

TEST_CASE("map_record: the energy of the finished map, over an isometry's, at the λ that is told") {
  MeshSource source = source_of(octahedron());
  source.topology = Topology(source.file.mesh);
  Parameterization result;
  result.map.points = source.file.mesh.positions;
  ParameterizeOptions options;
  const auto told = [&] {
    const Json json =
        Json::parse(to_json(MapRecord{.source = source, .options = options, .result = result}));
    return json["energy"].get<double>();
  };
  const double d = std::numbers::sqrt3 / std::numbers::pi, s = 1 / std::numbers::pi;
  CHECK(told() == Approx((d + (s * s + 1) / 2) / s / 2));
  result.balance = BalanceRecord{4, 0.1, true};
  CHECK(told() == Approx((d + 2 * (s * s + 1)) / s / 5));
  options.energy.kind = EnergyKind::SymmetricDirichlet;
  CHECK(told() == Approx(d * (1 + 1 / (s * s)) / 2));
  source.file.mesh.positions *= 1e-200;
  CHECK(told() == Approx(d * (1 + 1 / (s * s)) / 2));
}

TEST_CASE("map_record: a method of others has its account, and no weight of ours") {
  const MeshSource source = source_of(octahedron());
  const ParameterizeOptions options;
  const Parameterization result;
  const Json json = Json::parse(
      to_json(MapRecord{.source = source,
                        .options = options,
                        .result = result,
                        .method = "tangential",
                        .account = BaselineAccount{BaselineEnd::Stalled, 7, "no step", "A 1999"}}));
  CHECK(
      json["account"] ==
      Json(
          {{"source", "A 1999"}, {"end", "stalled"}, {"iterations", 7}, {"statement", "no step"}}));
  CHECK(keys_of(json["options"]) == "method,repair,repair_map");
  CHECK(json["options"]["method"] == "tangential");
  CHECK(json["lambda"].is_null());
  CHECK(json["energy"].is_null());
  CHECK(json["energy_gap"].is_null());
  CHECK(json["certificate"]["one_to_one"] == false);
  CHECK(json["chart"].is_null());
}

TEST_CASE("records: numbers that are not finite are null, names that are no UTF-8 are written") {
  const MeshSource source = source_of(octahedron(), "\xff.ply");
  const ParameterizeOptions options;
  Parameterization result;
  result.pole_cost = std::numeric_limits<double>::infinity();
  const Json json =
      Json::parse(to_json(MapRecord{.source = source, .options = options, .result = result}));
  CHECK(json["energy_cost"].is_null());
  CHECK(json["input"]["file"] == "\xef\xbf\xbd.ply");
}

TEST_CASE("inspection_record: a mesh that cannot be mapped, and what would mend it") {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  const MeshSource source = source_of(mesh);
  const InspectionRecord record{.source = source, .repair = try_repair(source), .seconds = 2};
  const Json json = Json::parse(to_json(record));
  CHECK(keys_of(json) ==
        "sphparam,command,input,inspection,crossings,fillers,cavities,repair,welded,provenance,"
        "body,counted_twice,notes,seconds");
  CHECK(json["inspection"]["mappable"] == false);
  CHECK(json["inspection"]["boundary_loops"] == 1);
  CHECK(json["inspection"]["defects"][0]["kind"] == "boundary-edge");
  CHECK(json["inspection"]["defects"][0]["count"] == 3);
  CHECK(json["repair"]["mends"] == true);
  CHECK(json["repair"]["mends_with"] == "--repair");
  CHECK(json["repair"]["actions"][0]["kind"] == "hole-filled");
  const std::string text = to_text(record);
  CHECK_THAT(text, StartsWith("ball.ply\n") && Contains("\n  vertices      42\n") &&
                       Contains("What is odd or wrong:\n") &&
                       Contains("as in `sphparam map folder/ball.ply --repair -o"));
  CHECK_THAT(to_text({.source = source}), !Contains("--repair would"));
}

TEST_CASE("inspection_record: a mesh that can be mapped needs nothing") {
  const MeshSource source = source_of(icosphere(1));
  CHECK(Json::parse(to_json(InspectionRecord{.source = source}))["repair"].is_null());
  CHECK_THAT(to_text({.source = source}),
             Catch::EndsWith("A closed genus-0 mesh: it can be mapped.\n"));
}

TEST_CASE("inspection_record: what a closed mesh encloses, as a body of density 1") {
  // An octahedron with corners a = 1, b = 2, c = 3 from (10, 0, 0): V = 4abc/3, ∫ x² = V a²/10.
  TriangleMesh mesh = octahedron();
  for (Eigen::Index v = 0; v < 6; ++v)
    mesh.positions.row(v) = mesh.positions.row(v).cwiseProduct(Eigen::RowVector3d(1, 2, 3)) +
                            Eigen::RowVector3d(10, 0, 0);
  const MeshSource source = source_of(mesh);
  const Json body = Json::parse(to_json(InspectionRecord{.source = source}))["body"];
  CHECK(keys_of(body) == "centroid,inertia,principal_moments,principal_axes,extents");
  const auto check_near = [](const Json& found, const Vector3& wanted) {
    for (int k = 0; k < 3; ++k)
      CHECK(found[size_t(k)].get<double>() == Approx(wanted[k]).margin(1e-12));
  };
  check_near(body["centroid"], {10, 0, 0});
  check_near(body["inertia"][0], {8 * 1.3, 0, 0});
  check_near(body["inertia"][1], {0, 8 * 1.0, 0});
  check_near(body["inertia"][2], {0, 0, 8 * 0.5});
  check_near(body["principal_moments"], {4, 8, 10.4});
  check_near(body["principal_axes"][0], {0, 0, 1});
  check_near(body["principal_axes"][1], {0, 1, 0});
  check_near(body["principal_axes"][2], {-1, 0, 0});
  CHECK_THAT(
      to_text({.source = source}),
      Contains("\n  centroid      (10, 0, 0)\n  inertia       4, 8, 10.4 about the centroid, "
               "at density 1, along (0, 0, 1), (0, 1, 0), (-1, 0, 0)\n"));
  TriangleMesh crooked = mesh;
  crooked.triangles.row(0).reverseInPlace();  // it would count from outside
  CHECK(Json::parse(to_json(InspectionRecord{.source = source_of(crooked)}))["body"].is_null());
  TriangleMesh huge = mesh;
  huge.positions *= 1e80;  // moments are fifth powers
  CHECK(Json::parse(to_json(InspectionRecord{.source = source_of(huge)}))["body"].is_null());
  mesh.triangles.conservativeResize(7, 3);
  const MeshSource open = source_of(mesh);
  CHECK(Json::parse(to_json(InspectionRecord{.source = open}))["body"].is_null());
  CHECK_THAT(to_text({.source = open}), !Contains("centroid"));
}

TEST_CASE("verification_record: where the rays are, what was proved, what is odd") {
  const TriangleMesh mesh = icosphere(2);
  VerifiedMap map;
  map.mesh = mesh;
  map.map = {mesh.positions};
  map.certificate = certify(Topology(mesh), map.map);
  const auto json_of = [&] {
    return Json::parse(to_json(VerificationRecord{.file = "a/ball.obj", .map = map}));
  };
  CHECK(keys_of(json_of()) ==
        "sphparam,command,input,file,sphere,rays,mean_length,length_deviation,angles,certificate,"
        "fillers,distortion,chart,warnings,notes,seconds");
  CHECK(json_of()["input"]["file"] == "a/ball.obj");
  CHECK(json_of()["input"]["triangles"] == 320);
  CHECK(json_of()["sphere"].is_null());
  CHECK(json_of()["angles"].is_null());
  CHECK(Json::parse(to_json(VerificationRecord{
            .file = "a.obj", .map = map, .sphere = "s.obj"}))["sphere"] == "s.obj");
  CHECK(json_of()["rays"] == "vertex positions");
  CHECK(json_of()["certificate"]["verdict"] == "one-to-one");
  CHECK(json_of()["notes"].empty());
  CHECK(roundness_warning(map).empty());
  map.length_deviation = 0.5;
  map.cut_otherwise = 3;
  CHECK_THAT(roundness_warning(map), StartsWith("these points are not on a sphere"));
  CHECK(json_of()["warnings"][0] == roundness_warning(map));
  CHECK(json_of()["notes"].empty());
  map.angles = AngleClaims{.off = 2, .farthest = 0.5};
  map.warnings = {"theta and phi"};
  CHECK(json_of()["angles"] == Json({{"off", 2}, {"farthest", 0.5}}));
  CHECK(json_of()["warnings"] == Json(warnings_of(map)));
  CHECK(json_of()["warnings"][1] == "theta and phi");
  CHECK(json_of()["rays"] == "vertex positions, 3 of its polygons cut as in the mesh");
  const std::string text = to_text({.file = "a/ball.obj", .map = map, .chart_wanted = true});
  CHECK_THAT(text,
             StartsWith("ball.obj: one-to-one, 320 triangles\n") && Contains("\n  chart: none, "));
  CHECK_THAT(to_text({.file = "a/ball.obj", .map = map}), !Contains("chart"));
}

TEST_CASE("distance_record: both ways, and what is more than a limit") {
  MeshFile first, second;
  first.mesh = icosphere(2);
  second.mesh = {1.5 * first.mesh.positions, first.mesh.triangles};
  const DistanceOptions options{.samples = 1000, .vertices = true};
  const SurfaceDistance distance = measure_distance(first.mesh, second.mesh, options);
  const DistanceRecord record{.first = "a.ply",
                              .second = "b.ply",
                              .first_file = first,
                              .second_file = second,
                              .options = options,
                              .distance = distance,
                              .limits = {{"rms", 1, 0.5}, {"max", 0.1, 0.5}, {"nan", 1, NAN}}};
  const Json json = Json::parse(to_json(record));
  CHECK(keys_of(json) ==
        "sphparam,command,first,second,sampled,upright,alignment,first_to_second,second_to_first,"
        "two_sided,"
        "limits,renamed,outputs,seconds");
  CHECK(json["sampled"]["on"] == Json({"faces", "vertices"}));
  CHECK(json["first_to_second"]["RMS"] == distance.forth.rms);
  CHECK(json["second_to_first"]["diag_mesh_0"] == distance.diagonal_second);
  CHECK(json["two_sided"]["max"] == distance.max());
  std::vector<bool> exceeded;
  for (const Json& limit : json["limits"]) exceeded.push_back(limit["exceeded"]);
  CHECK(exceeded == std::vector<bool>{false, true, true});
  CHECK_THAT(to_text(record), StartsWith("1: a.ply\n2: b.ply\n") && Contains("\nlarger"));
}

TEST_CASE("distance_record: of nearly all it is not said that all is within") {
  MeshFile ball;
  ball.mesh = icosphere(1);
  const DistanceOptions options{.within = 0.5};
  SurfaceDistance distance;
  const DistanceRecord record{.first = "a.ply",
                              .second = "b.ply",
                              .first_file = ball,
                              .second_file = ball,
                              .options = options,
                              .distance = distance};
  distance.forth.within = 0.99999;
  distance.back.within = 1;
  CHECK_THAT(to_text(record), Contains("\nwithin 0.5: 99.9 % of 1, 100 % of 2\n"));
  distance.forth.within = 0.25;
  CHECK_THAT(to_text(record), Contains("\nwithin 0.5: 25 % of 1,"));
}

TEST_CASE("harmonics_record: coefficients come back exactly, as JSON and as a table") {
  const MappedMesh mapped = ball();
  const HarmonicExpansion expansion = expand_in_harmonics(mapped, {}, {.degree = 2});
  const Json json = Json::parse(to_json(expansion, "ball.ply", {{"method", "none"}}));
  CHECK(keys_of(json) ==
        "sphparam,command,mesh,map,degree,basis,fit,iterations,converged,decided_degree,"
        "position_rms,position_rms_relative,position_rms_unweighted,rms,first_order_ellipsoid,"
        "functions");
  CHECK(json["converged"] == true);
  CHECK(json["decided_degree"] == 2);
  CHECK(undecided_line(expansion).empty());
  CHECK(json["map"]["method"] == "none");
  const Functions& coefficients = expansion.fit.coefficients;
  REQUIRE(json["functions"].size() == 3);
  CHECK(json["functions"][2]["name"] == "z");
  for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
    CHECK(json["functions"][2]["coefficients"][i] == coefficients(i, 2));
  const std::string table = to_csv(expansion);
  CHECK_THAT(table, StartsWith("l,m,x,y,z\n0,0,"));
  CHECK(line_count(table) == 1 + 9);
  std::string tabs = table;
  std::ranges::replace(tabs, ',', '\t');
  CHECK(to_csv(expansion, '\t') == tabs);
  const std::size_t row = table.find("\n1,0,");
  REQUIRE(row != std::string::npos);
  const std::string line = table.substr(row + 1, table.find('\n', row + 1) - row - 1);
  CHECK(std::stod(line.substr(line.rfind(',') + 1)) == coefficients(harmonic_index(1, 0), 2));
}

TEST_CASE(
    "harmonics_record: what vertices do not decide is told, with numbers where there are too few") {
  HarmonicExpansion expansion = expand_in_harmonics(ball(0), {}, {.degree = 4});
  expansion.fit.decided_degree = 2;
  CHECK(undecided_line(expansion) ==
        "25 coefficients for 12 vertices: the vertices decide harmonics up to degree 2, and what "
        "they leave open beyond is near the integral's");
  CHECK(Json::parse(to_json(expansion, "b", {}))["decided_degree"] == 2);
  HarmonicExpansion enough = expand_in_harmonics(ball(), {}, {.degree = 4});
  enough.fit.decided_degree = 3;
  CHECK_THAT(undecided_line(enough), StartsWith("the vertices decide harmonics up to degree 3"));
  enough.fit.decided_change = 0.0009;
  CHECK(decided_change_line(enough).empty());
  enough.fit.decided_change = 0.25;
  CHECK(decided_change_line(enough) ==
        "coefficients up to degree 3 are other ones than those of a fit of degree 3, too, of one "
        "degree by 25 % of their size");
}

TEST_CASE("harmonics_record: 4π-normalised coefficients, and SHADR of the radius") {
  const MappedMesh mapped = ball();
  HarmonicExpansion expansion =
      expand_in_harmonics(mapped, {}, {.degree = 2}, Vector3(0.1, 0.2, 0.3));
  REQUIRE(expansion.functions.back() == "radius");
  const Functions orthonormal = expansion.fit.coefficients;
  expansion.normalisation = HarmonicNormalisation::FourPi;
  const Json json = Json::parse(to_json(expansion, "ball.ply", {}));
  CHECK_THAT(json["basis"].get<std::string>(), Contains("4pi-normalised"));
  CHECK(json["centre"] == Json({0.1, 0.2, 0.3}));
  CHECK(json["reference_radius"] == json["functions"][3]["coefficients"][0]);
  CHECK_THAT(further_lines(expansion).back(), StartsWith("radius about 0.1, 0.2, 0.3: RMS "));
  const double factor = 1 / std::sqrt(4 * std::numbers::pi);
  for (Eigen::Index i = 0; i < orthonormal.rows(); ++i) {
    CHECK(json["functions"][3]["coefficients"][i].get<double>() ==
          Approx(factor * orthonormal(i, 3)).margin(1e-15));
  }
  CHECK_THAT(to_csv(expansion), StartsWith("l,m,x (4pi),y (4pi),z (4pi),radius (4pi)\n"));
  expansion.functions.back() = "a,\"b\"";
  CHECK_THAT(to_csv(expansion), StartsWith("l,m,x (4pi),y (4pi),z (4pi),\"a,\"\"b\"\" (4pi)\"\n"));
  expansion.functions.back() = "radius";
  // A point off the centre of a ball: the radius is 1 − a·x to first order, C_10 = −a_z/√3.
  const std::string shadr = to_shadr(expansion);
  std::vector<std::vector<double>> rows;
  std::istringstream lines(shadr);
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.back() == '\r');
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  REQUIRE(rows.size() == 1 + 6);  // l, m ≥ 0 to degree 2
  CHECK(rows[0].size() == 8);
  CHECK(rows[0][3] == 2);
  CHECK(rows[0][5] == 1);  // normalised
  CHECK(rows[0][0] == rows[1][2]);
  CHECK(rows[1][2] == Approx(factor * orthonormal(0, 3)));
  CHECK(rows[2][0] == 1);
  CHECK(rows[2][1] == 0);
  CHECK(rows[2][2] == Approx(factor * orthonormal(harmonic_index(1, 0), 3)));
  CHECK(rows[2][2] == Approx(-0.3 / std::sqrt(3)).epsilon(0.1));
  CHECK(rows[3][3] == Approx(factor * orthonormal(harmonic_index(1, -1), 3)));
  CHECK(rows[3][3] == Approx(-0.2 / std::sqrt(3)).epsilon(0.1));
  CHECK_THROWS_AS(to_shadr(expansion, "gravity"), std::invalid_argument);
}

TEST_CASE("harmonics_record: what was told is read again, in either normalisation") {
  HarmonicExpansion expansion =
      expand_in_harmonics(ball(), {}, {.degree = 3}, Vector3(0.1, 0.2, 0.3));
  const Provenance map = {{"method", "radial"}, {"upright", "+y"}};
  const HarmonicExpansion same = parse_harmonics(to_json(expansion, "ball.ply", map), "b.json");
  CHECK(same.functions == expansion.functions);
  CHECK(same.fit.coefficients == expansion.fit.coefficients);
  CHECK(same.map == map);
  CHECK(same.aligned == HarmonicAlignment::None);
  CHECK(same.radius_about == Vector3(0.1, 0.2, 0.3));
  CHECK(same.fit.rms.size() == 0);
  expansion.normalisation = HarmonicNormalisation::FourPi;
  const HarmonicExpansion other = parse_harmonics(to_json(expansion, "ball.ply", map), "b.json");
  CHECK(other.normalisation == HarmonicNormalisation::FourPi);
  CHECK((other.fit.coefficients - expansion.fit.coefficients).cwiseAbs().maxCoeff() < 1e-15);
  // Of it nothing is told that is not known; what is comes back again.
  const std::string again = to_json(same, "ball.ply", same.map);
  CHECK(keys_of(Json::parse(again)) ==
        "sphparam,command,mesh,map,degree,basis,centre,reference_radius,first_order_ellipsoid,"
        "functions");
  CHECK(parse_harmonics(again, "b.json").fit.coefficients == same.fit.coefficients);
  const HarmonicExpansion coef =
      parse_harmonics("{ 4,{1, 2, 3},\n{4, 5, 6},\n{0, 0, 0},\n{0, 0, 0}}", "b.COEF");
  CHECK(coef.functions == std::vector<std::string>{"x", "y", "z"});
  CHECK(coef.fit.coefficients.row(2) == Eigen::RowVector3d(4, 5, 6));
}

TEST_CASE("harmonics_record: no two functions have one name") {
  MeshFile file = ball().file();
  const auto count = static_cast<size_t>(file.mesh.vertex_count());
  file.set_vertex_property({"radius", ScalarType::Float64, std::vector<double>(count, 1)});
  const MappedMesh mapped({.file = file, .map = ball().map()});
  CHECK(expand_in_harmonics(mapped, {"radius"}, {.degree = 1}).functions.back() == "radius");
  CHECK_THROWS_WITH(expand_in_harmonics(mapped, {"radius"}, {.degree = 1}, Vector3(0, 0, 0)),
                    Contains("two functions would be called radius"));
  CHECK_THROWS_AS(expand_in_harmonics(mapped, {"radius", "radius"}, {.degree = 1}),
                  std::invalid_argument);
}

TEST_CASE("harmonics_record: of what was turned its place is not known") {
  HarmonicExpansion expansion = expand_in_harmonics(ball(), {}, {.degree = 2});
  for (const auto what : {HarmonicAlignment::Sphere, HarmonicAlignment::SphereAndSurface}) {
    HarmonicExpansion turned = expansion;
    align(turned, ball(), what);
    const HarmonicExpansion read =
        parse_harmonics(to_json(turned, "b", {{"method", "m"}, {"upright", "+y"}}), "b.json");
    CHECK(read.aligned == what);
    CHECK(read.map == Provenance{{"method", "m"}});
  }
}

TEST_CASE("harmonics_record: what is no record is refused, and says why") {
  const std::string good = to_json(expand_in_harmonics(ball(), {}, {.degree = 1}), "b", {});
  const auto without = [&](const std::string& old, const std::string& now) {
    std::string text = good;
    text.replace(text.find(old), old.size(), now);
    return text;
  };
  const auto refused = [](const std::string& text, const std::string& why) {
    CHECK_THROWS_WITH(parse_harmonics(text, "b.json"), StartsWith("b.json: ") && Contains(why));
    CHECK_THROWS_AS(parse_harmonics(text, "b.json"), ReadError);
  };
  for (const char* text : {"", "ply", "{", "[]", "3", "{\"functions\": 3}", "{\"functions\": [1]}"})
    refused(text, "as `sphparam spharm --json` writes them");
  refused("{\"functions\": []}", "no functions x, y and z");
  refused(without("\"name\": \"y\"", "\"name\": \"x\""), "each once, not x, x");
  refused(without("\"name\": \"y\"", "\"name\": \"z\""), "each once, not x, z");
  refused(without("\"basis\": \"real", "\"basis\": \"complex"),
          "its basis is none of ours: complex");
  refused(without("\"coefficients\": [", "\"coefficients\": [0,"), "not as many coefficients each");
  refused(without("\"coefficients\": [", "\"coefficients\": [null,"), "must be number");
  refused(without("\"coefficients\": [", "\"coefficients\": [1e999,"), "number overflow");
  std::string nine = good;
  for (size_t at = 0; (at = nine.find("\"coefficients\": [", at)) != std::string::npos; at += 20)
    nine.insert(at + 17, "0,");
  refused(nine, "5 coefficients are no (L + 1)²");
}

TEST_CASE("records: a file of coefficients asks for no more memory than it has numbers") {
  const auto function = [](const std::string& name, const std::string& coefficients) {
    return R"({"name": ")" + name + R"(", "coefficients": [)" + coefficients + "]}";
  };
  std::string many = "1";
  for (int i = 1; i < 1000 * 1000; ++i) many += ",1";
  std::string text = R"({"functions": [)" + function("x", many);
  for (const char* name : {"y", "z"}) text += ", " + function(name, "");
  for (int k = 0; k < 50'000; ++k) text += ", " + function("f" + std::to_string(k), "");
  CHECK_THROWS_AS(parse_harmonics(text + "]}", "b.json"), ReadError);  // 400 GB in a table
}

TEST_CASE("harmonics_record: for people, what is left in a line, and the ellipsoid") {
  const MappedMesh mapped = ball();
  const HarmonicExpansion expansion = expand_in_harmonics(mapped, {}, {.degree = 2});
  CHECK_THAT(residual_line(expansion),
             StartsWith("degree 2, RMS distance at the vertices, weighted by solid angle, ") &&
                 Contains(" % of the diagonal), unweighted "));
  const std::vector<std::string> lines = further_lines(expansion);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], StartsWith("first-order ellipsoid: semi-axes 1"));
  CHECK(further_lines(expand_in_harmonics(mapped, {}, {.degree = 0})).empty());
}

TEST_CASE("bake_record: images, and what they are for") {
  const MappedMesh source = ball();
  BakeSettings settings{.width = 64, .samples = 2};
  settings.source_name = "ball.ply";
  BakeReport baked;
  baked.images = {{.field = "ao", .about = "share", .path = "out/ao.png", .range = {{0, 1}}}};
  const BakeRecord record{"in/ball.ply", source, "", "", settings, baked, 3};
  const Json json = Json::parse(to_json(record));
  CHECK(keys_of(json) ==
        "sphparam,command,source,for,for_distance,width,height,samples,convention,refine_poles,"
        "images,"
        "warnings,seconds");
  CHECK(json["warnings"] == Json::array());
  baked.warnings = {"in another unit"};
  CHECK(Json::parse(to_json(record))["warnings"] == Json({"in another unit"}));
  settings.fields.body = body_of("Vesta", 1000);
  baked.coordinate_system = "Vesta (2015) - Sphere / Ocentric";
  const Json of_body = Json::parse(to_json(record))["body"];
  CHECK(of_body["name"] == "Vesta");
  CHECK(of_body["unit_metres"] == 1000);
  CHECK(of_body["coordinate_system"] == baked.coordinate_system);
  CHECK(json["source"] == Json({{"file", "in/ball.ply"}, {"triangles", 320}}));
  CHECK(json["for"].is_null());
  CHECK(json["height"] == 32);
  CHECK(json["images"][0]["file"] == "out/ao.png");
  CHECK(json["images"][0]["range"] == Json({0.0, 1.0}));
  CHECK(json["images"][0]["beyond"] == 0);
  CHECK(line_of(baked.images[0], settings) == "ball.ply: ao, 64 × 32 uint8 → ao.png");
  baked.images[0].beyond = 0.025;
  CHECK_THAT(line_of(baked.images[0], settings),
             Catch::EndsWith("; 2.5 % of the texels lie beyond 0 to 1, and end there"));
  CHECK(Json::parse(to_json(record))["images"][0]["beyond"] == 0.025);
  baked.images[0].range = {101325, 101325.25};
  CHECK_THAT(line_of(baked.images[0], settings),
             Catch::EndsWith("texels lie beyond 101325 to 101325.25, and end there"));
  baked.images[0].range = {101324.5, 101325.5};
  CHECK_THAT(line_of(baked.images[0], settings),
             Catch::EndsWith("texels lie beyond 101324.5 to 101325.5, and end there"));
  baked.images[0].range = {0, 1};
  baked.images[0].beyond = std::numeric_limits<double>::quiet_NaN();  // not counted
  CHECK_FALSE(Json::parse(to_json(record))["images"][0].contains("beyond"));
  CHECK(line_of(baked.images[0], settings) == "ball.ply: ao, 64 × 32 uint8 → ao.png");
  baked.images[0].sidecar = "out/ao.png.aux.xml";
  CHECK(line_of(baked.images[0], settings) ==
        "ball.ply: ao, 64 × 32 uint8 → ao.png, ao.png.aux.xml");
}

TEST_CASE("bake_record: a mesh that lies on the surface baked from has no shares to tell") {
  const BakeSettings settings{.source_name = "the asset"};
  CHECK(line_of(ProjectionShares{.farthest = 1e-12}, settings) ==
        "the asset: the mesh lies on it everywhere");
  CHECK_THAT(line_of(ProjectionShares{.nearest = 0.25, .farthest = 0.5}, settings),
             Contains("0 % of the mesh shows its back, 25 %"));
}

TEST_CASE("export_record: what is proved of each level, and the files") {
  ChartFigures chart;
  chart.splits = 3;
  ExportRecord record{.input = "ball.ply", .charts = {chart}, .outputs = {{"ball.glb", 1234}}};
  Json json = Json::parse(to_json(record));
  CHECK(keys_of(json) == "sphparam,command,input,levels,lods_wanted,lods,outputs,textures,seconds");
  CHECK(json["textures"].empty());
  CHECK(json["levels"][0]["splits"] == 3);
  CHECK(json["levels"][0]["chart_certified"] == false);
  CHECK_FALSE(json["levels"][0].contains("sphere_folds_as_stored"));
  CHECK(json["outputs"] == Json::array({{{"file", "ball.glb"}, {"bytes", 1234}}}));
  record.charts[0].sphere_folds = 0;
  record.textures = {
      {.name = "skin", .kind = "webp", .given_bytes = 100, .bytes = 80, .exact = true}};
  json = Json::parse(to_json(record));
  CHECK(json["textures"][0] == Json({{"name", "skin"},
                                     {"kind", "webp"},
                                     {"bytes", 80},
                                     {"bytes_as_given", 100},
                                     {"exact", true}}));
  CHECK(json["levels"][0]["sphere_folds_as_stored"] == 0);
  CHECK(level_lines(record).empty());
  CHECK_FALSE(json["levels"][0].contains("rms"));
  ChartFigures coarse;
  coarse.triangles = 320;
  record.charts.push_back(coarse);
  record.distances.push_back(LevelOfDetail::Distance{.rms = 0.5, .max = 2});
  record.diagonal = 100;
  json = Json::parse(to_json(record));
  CHECK_FALSE(json["levels"][0].contains("rms"));
  CHECK(json["levels"][1]["rms"] == 0.5);
  CHECK(json["levels"][1]["max"] == 2);
  CHECK(level_lines(record) ==
        std::vector<std::string>{
            "level 1, 320 triangles: RMS 0.5 %, at most 2 % of the diagonal, both ways"});
  CHECK_FALSE(json["levels"][1].contains("in_space"));
  CHECK(warnings_of(record).empty());
  record.in_space.push_back(
      {.crossings = {.pairs = 4, .faces = 6}, .faces = 7, .area_share = 0.25, .source_pairs = 1});
  json = Json::parse(to_json(record));
  CHECK_FALSE(json["levels"][0].contains("in_space"));
  CHECK(json["levels"][1]["in_space"]["triangles"] == 7);
  CHECK(json["levels"][1]["in_space"]["area_share"] == 0.25);
  CHECK(json["levels"][1]["in_space"]["crossings"]["pairs"] == 4);
  CHECK(warnings_of(record) ==
        std::vector<std::string>{
            "level 1: 7 triangles, 25 % of the area, cross others in space or lie inverted; of the "
            "mesh itself 1 pair crosses: what is proved is the map"});
  record.in_space[0] = {.crossings = {.all = false}};
  CHECK_THAT(warnings_of(record).at(0), Contains("level 1: too many triangles are near"));
  record.in_space[0] = {};
  CHECK(warnings_of(record).empty());
  record.distances[0].reset();
  CHECK_FALSE(Json::parse(to_json(record))["levels"][1].contains("rms"));
  CHECK(level_lines(record).empty());
}

TEST_CASE("remesh_record: the finest level, and the others where there are several") {
  const MappedMesh source = ball();
  const std::vector<GridSpec> grids = {parse_grid("ico:2"), parse_grid("ico:1")};
  std::vector<LevelOfDetail> levels = levels_of_detail(source, grids);
  const auto record_of = [&] {
    return RemeshRecord{.input = "in/ball.ply",
                        .grid = "ico:2",
                        .source = source,
                        .levels = levels,
                        .outputs = {.mesh = "low.ply", .levels = {"low_0.ply", "low_1.ply"}}};
  };
  Json json = Json::parse(to_json(record_of()));
  CHECK(keys_of(json) ==
        "sphparam,command,input,grid,sample,averaged_vertices,carried,certified,in_space,warnings,"
        "lods,outputs,seconds");
  CHECK(json["grid"]["vertices"] == 162);
  CHECK(json["lods"][1]["file"] == "low_1.ply");
  CHECK(json["lods"][1]["rms"] == levels[1].distance->rms);
  CHECK(keys_of(json["outputs"]) ==
        "mesh,limit_mesh,displacement,rebuilt,geometry_image,normals,attribute_images,csv,data");
  CHECK(keys_of(json["seconds"]) == "grid,location,positions,total");
  CHECK(line_count(to_text(record_of())) == 3);
  levels.pop_back();
  json = Json::parse(to_json(record_of()));
  CHECK_FALSE(json.contains("lods"));
  CHECK(to_text(record_of()) ==
        "ball.ply: ico:2, 162 vertices, certified one-to-one, 0 s → low_0.ply\n");
}

TEST_CASE(
    "remesh_record: a grid that was sought says how near it is, or that none is near enough") {
  const MappedMesh source = ball();
  const std::vector<GridSpec> grids = {parse_grid("ico:1")};
  const std::vector<LevelOfDetail> levels = levels_of_detail(source, grids, {.measure = false});
  const auto record_of = [&](double most) {
    return RemeshRecord{.input = "ball.ply",
                        .grid = "ico:1",
                        .source = source,
                        .levels = levels,
                        .within = GridWithin{.grid = grids[0], .most = most, .max = 0.25}};
  };
  const Json held = Json::parse(to_json(record_of(0.25)));
  CHECK(held["within"] == Json({{"most", 0.25}, {"max", 0.25}, {"held", true}}));
  CHECK(warnings_of(record_of(0.25)).empty());
  CHECK_THAT(to_text(record_of(0.25)), StartsWith("  ico:1: at most 0.25 ("));
  const Json missed = Json::parse(to_json(record_of(0.125)));
  CHECK(missed["within"] == Json({{"most", 0.125}, {"max", 0.25}, {"held", false}}));
  REQUIRE(warnings_of(record_of(0.125)).size() == 1);
  CHECK_THAT(warnings_of(record_of(0.125))[0],
             StartsWith("ico:1: at most 0.25 (") &&
                 Catch::EndsWith(
                     "from the mesh, either way, more than 0.125: no finer grid is looked at"));
  CHECK_THAT(to_text(record_of(0.125)), StartsWith("ball.ply: ico:1, "));
}

TEST_CASE("remesh_record: a displacement that does harm says so") {
  const MappedMesh source = ball();
  const std::vector<GridSpec> grids = {parse_grid("ico:1")};
  const std::vector<LevelOfDetail> levels = levels_of_detail(source, grids, {.measure = false});
  WrittenDisplacement written{.width = 64, .height = 32};
  written.figures.missed = 1;
  written.proof = RebuildProof{.base = {0.1, 0.2}, .rebuilt = {0.3, 0.4}};
  const RemeshRecord record{.input = "ball.ply",
                            .grid = "ico:1",
                            .source = source,
                            .levels = levels,
                            .displacement = written,
                            .outputs = {.displacement = "d.exr", .rebuilt = "r.ply"}};
  const Json json = Json::parse(to_json(record))["displacement"];
  CHECK(keys_of(json) == "file,width,height,layout,scale,midlevel,min,max,texels,seconds,rebuilt");
  CHECK(json["width"] == 64);
  CHECK(json["texels"]["missed"] == 1);
  CHECK(json["rebuilt"]["error"] == Json({{"rms", 0.3}, {"max", 0.4}}));
  CHECK(json["rebuilt"]["warnings"] == Json::array({farther_warning}));
  CHECK_THAT(to_text(record), Contains(", 1 texel whose normal misses the mesh\n") &&
                                  Contains("\n  rebuilt: RMS ") && !Contains("→"));
}

TEST_CASE("comparison_record: maps side by side, also where there is none") {
  const MeshSource source = source_of(icosphere(1));
  const std::vector<Entry> entries = {
      entry_of_map("peer", "peer.obj", source.file.mesh, {source.file.mesh.positions}, 0),
      Entry{.name = "none", .source = "A 1999", .seconds = 2, .iterations = 5}};
  const Json json = Json::parse(to_json(ComparisonRecord{"report", source, entries, 4}));
  CHECK(keys_of(json) == "sphparam,command,input,maps,notes,seconds");
  CHECK(json["command"] == "report");
  CHECK(json["maps"][0]["certificate"]["one_to_one"] == true);
  CHECK(json["maps"][0]["seconds"].is_null());
  CHECK(json["maps"][1]["has_map"] == false);
  CHECK(json["maps"][1]["certificate"].is_null());
  CHECK(json["maps"][1]["iterations"] == 5);
}
