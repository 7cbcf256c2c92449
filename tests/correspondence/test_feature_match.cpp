#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "correspondence/feature_scales.h"
#include "embedding/frame/nearest_rotation.h"
#include "sphparam/correspondence/feature_file.h"
#include "sphparam/correspondence/map_alignment.h"
#include "sphparam/correspondence/match.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/parameterize.h"
#include "support/folder.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// A pattern without symmetry, of places as wide as a fifth of the sphere.
double pattern(const Vector3& x) {
  return std::sin(4 * x.x() + 1) * std::cos(3 * x.y() - 2 * x.z()) + 0.7 * std::sin(5 * x.z()) +
         0.5 * x.x() + 0.3 * std::cos(6 * x.y() + 2 * x.x());
}

/// What is round z is turned by up to 0.5, less towards the poles: one-to-one, and of equal area.
Vector3 twisted(const Vector3& x) {
  const double angle = 0.5 * (1 - x.z() * x.z()) * (1 + x.z());
  return Eigen::AngleAxisd(angle, Vector3::UnitZ()) * x;
}

Functions values_at(const Points& points, Vector3 (*moved)(const Vector3&)) {
  Functions values(points.rows(), 1);
  for (Vertex v = 0; v < points.rows(); ++v)
    values(v, 0) = pattern(moved(Vector3(points.row(v)).normalized()));
  return values;
}

Vector3 as_it_is(const Vector3& x) { return x; }

Eigen::Matrix3d rotation_by(double angle) {
  return Eigen::AngleAxisd(angle, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
}

MappedMesh ball(int level) {
  const TriangleMesh mesh = icosphere(level);
  return mapped(mesh, {mesh.positions});
}

MatchFeatures twisted_features(const MappedMesh& from, const MappedMesh& to, double weight) {
  return {values_at(from.mesh().positions, twisted), values_at(to.mesh().positions, as_it_is),
          weight};
}

/// Root of the mean square of distances from where the twist has the vertices.
double error_of(const Match& match, Vector3 (*truth)(const Vector3&)) {
  const Points& points = match.map.from().map().points;
  double sum = 0;
  for (Vertex v = 0; v < points.rows(); ++v)
    sum += (Vector3(points.row(v)) -
            truth(Vector3(match.map.from().mesh().positions.row(v)).normalized()))
               .squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.rows()));
}

}  // namespace

TEST_CASE("match by features: a known warp of a ball is found, one-to-one") {
  const MappedMesh from = ball(4), to = ball(4);
  const Match match = match_surfaces(from, to, {.features = twisted_features(from, to, 20)});
  CHECK(match.made_by == "features");
  CHECK(match.map.from().certificate().bijective());
  CHECK(match.map.to().map().points == to.map().points);
  CHECK(match.agreement > 0.99);
  CHECK(match.confidence > 0.5);
  CHECK(error_of(match, as_it_is) > 0.3);
  CHECK(error_of(match, twisted) < 0.2 * error_of(match, as_it_is));
}

TEST_CASE(
    "match by features: the greater their weight, the better they agree and the less the "
    "map is an isometry") {
  const MappedMesh from = ball(3), to = ball(3);
  double agreement = 0, energy = 0;
  for (const double weight : {0.1, 2.0, 20.0}) {
    const Match match = match_surfaces(from, to, {.features = twisted_features(from, to, weight)});
    CHECK(match.agreement > agreement);
    CHECK(match.energy > energy);
    agreement = match.agreement;
    energy = match.energy;
  }
}

TEST_CASE(
    "match by features: a map that is only turned is turned back, whatever the unit of "
    "what is to agree") {
  const MappedMesh to = ball(4);
  const MappedMesh from = turned_map(to, rotation_by(2.5));
  const Functions values = values_at(to.mesh().positions, as_it_is);
  const Functions other_unit = (100 + 7 * values.array()).matrix();
  const Match match = match_surfaces(from, to, {.features = MatchFeatures{values, other_unit}});
  CHECK(error_of(match, as_it_is) < 0.01);
  CHECK(match.agreement > 0.999);
}

TEST_CASE("match by features: the same bytes for any number of threads") {
  const MappedMesh from = ball(3), to = ball(4);
  const auto points = [&](int threads) {
    return match_surfaces(from, to, {.features = twisted_features(from, to, 2), .threads = threads})
        .map.from()
        .map()
        .points;
  };
  CHECK(points(1) == points(3));
}

TEST_CASE("match by features: landmarks beside them are met exactly") {
  const MappedMesh from = ball(3), to = ball(4);
  MatchOptions options{.features = twisted_features(from, to, 5)};
  for (const Vertex v : {0, 3, 5, 8}) options.landmarks.push_back({v, v + 20});
  const Match match = match_surfaces(from, to, options);
  CHECK(match.made_by == "features");
  for (size_t i = 0; i < 4; ++i) CHECK(match.residuals[i] == 0);
}

TEST_CASE("match by features: values that are not finite and wild ones say little") {
  const MappedMesh from = ball(4), to = ball(4);
  MatchFeatures features = twisted_features(from, to, 20);
  for (Vertex v = 0; v < 40; ++v) {
    features.from(7 * v, 0) = std::numeric_limits<double>::quiet_NaN();
    features.to(5 * v + 3, 0) = 1e6;
  }
  const Match match = match_surfaces(from, to, {.features = features});
  CHECK(error_of(match, twisted) < 0.15);
}

TEST_CASE("match by features: what is known of a part of one side alone is compared there alone") {
  const MappedMesh to = ball(4);
  const MappedMesh from = turned_map(to, rotation_by(2.5));
  Functions here = values_at(to.mesh().positions, as_it_is);
  here += 3 * to.mesh().positions.col(0);  // so that the median of a part is far from the other's
  const Functions there = here;
  const Match whole = match_surfaces(from, to, {.features = MatchFeatures{here, there}});
  CHECK(error_of(whole, as_it_is) < 0.01);
  CHECK(whole.warnings.empty());
  for (Vertex v = 0; v < here.rows(); ++v)
    if (to.mesh().position(v).z() < -1.0 / 3) here(v, 0) = std::numeric_limits<double>::quiet_NaN();
  const Match match = match_surfaces(from, to, {.features = MatchFeatures{here, there}});
  REQUIRE_FALSE(match.warnings.empty());
  CHECK_THAT(match.warnings[0], Catch::Contains("feature 1 is known on 66.") &&
                                    Catch::Contains("and on 100 %") &&
                                    Catch::Contains("where both are known"));
  CHECK(error_of(match, as_it_is) < 0.05);
  CHECK(match.confidence < 0.95);
  CHECK(match.agreement > 0.99);
  const Match back = match_surfaces(from, to, {.features = MatchFeatures{there, here}});
  CHECK(error_of(back, as_it_is) < 0.05);
  // Where both sides leave the same part out, nothing is amiss.
  const Match both = match_surfaces(from, to, {.features = MatchFeatures{here, here}});
  CHECK(error_of(both, as_it_is) < 0.01);
  CHECK(both.warnings.empty());
}

TEST_CASE("match by features: beside landmarks, too, what one side knows alone is left out") {
  const MappedMesh to = ball(4);
  const MappedMesh from = turned_map(to, rotation_by(2.5));
  Functions here = values_at(to.mesh().positions, as_it_is);
  here += 3 * to.mesh().positions.col(0);
  const Functions there = here;
  for (Vertex v = 0; v < here.rows(); ++v)
    if (to.mesh().position(v).z() < -1.0 / 3) here(v, 0) = std::numeric_limits<double>::quiet_NaN();
  MatchOptions options{.features = MatchFeatures{here, there, 20}};
  for (const Vertex v : {0, 3, 5, 8}) options.landmarks.push_back({v, v});
  const Match match = match_surfaces(from, to, options);
  CHECK(error_of(match, as_it_is) < 0.05);
  CHECK(match.agreement > 0.99);
}

TEST_CASE("match by features: a sign that is the opposite on one side is told") {
  const MappedMesh from = ball(3), to = ball(3);
  MatchFeatures features = twisted_features(from, to, 2);
  CHECK(match_surfaces(from, to, {.features = features}).warnings.empty());
  features.from *= -1;
  const auto told = [&](const MatchOptions& options) {
    std::string all;
    for (const std::string& warning : match_surfaces(from, to, options).warnings) all += warning;
    return all;
  };
  CHECK_THAT(told({.features = features}), Catch::Contains("opposite sign"));
  // Beside a feature that tells the turn.
  MatchFeatures two = twisted_features(from, to, 2);
  two.from.conservativeResize(Eigen::NoChange, 2);
  two.to.conservativeResize(Eigen::NoChange, 2);
  two.from.col(1) = -from.mesh().positions.col(0);
  two.to.col(1) = to.mesh().positions.col(0);
  CHECK_THAT(told({.alike = true, .features = two}),
             Catch::Contains("feature 2 agrees with the opposite sign"));
}

TEST_CASE("match by features: of surfaces that lie alike, places tell the turn") {
  const MappedMesh to = ball(4);
  const MappedMesh from = turned_map(to, rotation_by(2.5));
  const Functions height = to.mesh().positions.col(2);  // looks alike after any turn about z
  const MatchFeatures features{height, height};
  const Match match = match_surfaces(from, to, {.alike = true, .features = features});
  CHECK(error_of(match, as_it_is) < 0.01);
  CHECK(match.warnings.empty());
}

TEST_CASE("match by features: that they pull apart what lies alike is told") {
  const MappedMesh from = ball(4), to = ball(4);
  const auto matched = [&](const MatchFeatures& features) {
    return match_surfaces(from, to, {.alike = true, .features = features});
  };
  const Match far = matched(twisted_features(from, to, 20));
  const Points &places = from.mesh().positions, &moved = far.map.from().map().points;
  double mean = 0;
  for (int c = 0; c < 3; ++c)
    mean += places.col(c).dot(moved.col(c)) / (3 * places.col(c).norm() * moved.col(c).norm());
  CHECK(far.place_agreement == Approx(mean).margin(0.005));
  REQUIRE(far.warnings.size() == 1);
  CHECK_THAT(far.warnings[0],
             Catch::StartsWith("the features pulled apart what lies alike in space: places "
                               "correlate by 0.9") &&
                 Catch::Contains(", and by 1 after the turn that all began with: "));
  const Functions same = values_at(to.mesh().positions, as_it_is);
  const Match near = matched({same, same});
  CHECK(near.place_agreement > 0.99);
  CHECK(near.warnings.empty());
}

TEST_CASE("match by features: what says nothing is refused") {
  const MappedMesh from = ball(1), to = ball(1);
  const auto attempt = [&](MatchFeatures features, bool search = false) {
    return match_surfaces(from, to, {.search = search, .features = std::move(features)});
  };
  const Functions some = values_at(from.mesh().positions, as_it_is);
  const Functions constant = Functions::Ones(some.rows(), 1);
  using Catch::Contains;
  CHECK_THROWS_WITH(attempt({some, constant}), Contains("the same everywhere"));
  CHECK_THROWS_WITH(attempt({constant, some}), Contains("column 1"));
  CHECK_THROWS_WITH(attempt({some, some.topRows(3)}), Contains("a row a vertex"));
  CHECK_THROWS_WITH(attempt({Functions(some.rows(), 0), Functions(some.rows(), 0)}),
                    Contains("columns"));
  CHECK_THROWS_WITH(attempt({some, some, 0}), Contains("weight"));
  CHECK_THROWS_WITH(attempt({some, some}, true), Contains("search"));
  for (const double lambda : {-1.0, std::nan(""), 1e7})
    CHECK_THROWS_WITH(match_surfaces(from, to, {.energy = {.lambda = lambda}}),
                      Contains("lambda is "));
}

TEST_CASE(
    "feature scales: averages have the mean 0 and the mean square 1, and forget what is "
    "small") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  Functions values(mesh.vertex_count(), 1);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v)
    values(v, 0) = mesh.position(v).z() + (v % 2 == 0 ? 0.3 : -0.3);
  const FeatureScales scales(mesh, topology, mesh, topology, {values, values});
  const Functions near = scales.at(0.01).from, far = scales.at(0.5).from;
  const VectorX ones = VectorX::Ones(mesh.vertex_count());
  for (const Functions& field : {near, far}) {
    CHECK(field.mean() == Approx(0).margin(1e-2));
    CHECK(field.squaredNorm() / static_cast<double>(field.rows()) == Approx(1).epsilon(1e-2));
  }
  CHECK(correlation_of(far, mesh.positions.col(2), ones) > 0.999);
  CHECK(correlation_of(near, mesh.positions.col(2), ones) < 0.95);
}

TEST_CASE("feature files: columns of a file, or a property of the mesh") {
  const Folder folder;
  MeshFile mesh;
  mesh.mesh = icosahedron();
  VertexData data;
  data.columns = {{.name = "a", .values = {}}, {.name = "b", .values = {}}};
  for (int v = 0; v < 12; ++v) {
    data.columns[0].values.push_back(v);
    data.columns[1].values.push_back(-v);
  }
  const std::string path = folder / "two.shape.gii";
  write_vertex_data(path, data);
  const Functions columns = read_features(path, mesh);
  REQUIRE(columns.cols() == 2);
  CHECK(columns(5, 0) == 5);
  CHECK(columns(5, 1) == -5);
  mesh.vertex_properties.push_back({.name = "sulc", .values = data.columns[0].values});
  CHECK(read_features("sulc", mesh).col(0) == columns.col(0));
  CHECK_THROWS_AS(read_features("curv", mesh), ReadError);
  CHECK_THROWS_AS(read_features(std::string(5000, 'x'), mesh), ReadError);
  MeshFile other;
  other.mesh = octahedron();
  CHECK_THROWS_AS(read_features(path, other), ReadError);
  data.kind = DataKind::Labels;
  data.columns.pop_back();
  const std::string labels = folder / "some.label.gii";
  write_vertex_data(labels, data);
  CHECK_THROWS_WITH(read_features(labels, mesh), Catch::Contains("labels"));
  CHECK(read_features({path, path, "sulc", "sulc"}, mesh, mesh).from.cols() == 3);
  CHECK_THROWS_WITH(read_features({path, "sulc"}, mesh, mesh),
                    Catch::Contains("2 columns") || Catch::Contains("1 column"));
  CHECK_THROWS_AS(read_features({path}, mesh, mesh), std::invalid_argument);
}

TEST_CASE("feature files: whole numbers are labels, and what is the same everywhere is refused") {
  MeshFile mesh;
  mesh.mesh = icosahedron();
  Property lab{"lab", ScalarType::Int32, {}}, same{"same", ScalarType::Float32, {}};
  Property sulc{"sulc", ScalarType::Float64, {}};
  for (int v = 0; v < 12; ++v) {
    lab.values.push_back(v % 3);
    same.values.push_back(2);
    sulc.values.push_back(v);
  }
  mesh.vertex_properties = {lab, same, sulc};
  using Catch::Contains;
  CHECK_THROWS_AS(read_features("lab", mesh), ReadError);
  CHECK_THROWS_WITH(read_features("lab", mesh), Contains("lab") && Contains("labels"));
  CHECK_THROWS_AS(read_features({"sulc", "same"}, mesh, mesh), ReadError);
  CHECK_THROWS_WITH(read_features({"same", "sulc"}, mesh, mesh),
                    Contains("same") && Contains("no two different numbers"));
  CHECK(read_features({"sulc", "sulc"}, mesh, mesh).to.cols() == 1);
}

namespace {

/// A pebble that is like no turned or mirrored image of itself, and has no ends.
MappedMesh pebble(int level, double bump, const Eigen::Matrix3d& turn) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    const double swell = 0.25 * std::exp(-4 * (x - Vector3(0.8, 0.6, 0)).squaredNorm()) +
                         bump * std::exp(-4 * (x - Vector3(0, -0.6, 0.8)).squaredNorm());
    mesh.positions.row(v) = turn * (Vector3(1.3, 1, 0.8).cwiseProduct(x) * (1 + swell));
  }
  return mapped(mesh, parameterize(mesh).map);
}

}  // namespace

TEST_CASE("match by a turn: a shape without ends finds its turned copy of other triangles") {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  const MappedMesh from = pebble(4, 0.15, Eigen::Matrix3d::Identity());
  const MappedMesh to = pebble(3, 0.15, turn);
  const Match match = match_surfaces(from, to, {.search = true});
  CHECK(match.suggestions.empty());
  CHECK(match.confidence > 0.3);
  CHECK(summarise(measure_distortion(match.map)).symmetric_dirichlet < 4.1);
  const TriangleMesh there = match.map.from_on_to();
  CHECK((there.positions - from.mesh().positions * turn.transpose()).rowwise().norm().mean() <
        0.05);
}

TEST_CASE("match by a turn: of a ball every turn is as good, which is told") {
  const MappedMesh from = ball(3), to = ball(2);
  const Match match = match_surfaces(from, to, {.search = true});
  CHECK(match.map.from().certificate().bijective());
  CHECK(match.confidence < 0.15);
  REQUIRE(match.warnings.size() == 1);
  CHECK_THAT(match.warnings[0], Catch::Contains("after another turn"));
}

TEST_CASE("match by a turn: places in space tell how a ball lies, if they may") {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  const MappedMesh from = turned_map(ball(3), turn), to = ball(2);
  const Match match = match_surfaces(from, to, {.search = true, .alike = true});
  CHECK(match.confidence > 0.9);
  CHECK(match.warnings.empty());
  const TriangleMesh there = match.map.from_on_to();
  CHECK((there.positions - from.mesh().positions).rowwise().norm().mean() < 0.05);
}
