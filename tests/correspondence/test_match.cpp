#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "mesh/triangle_geometry.h"
#include "sphparam/correspondence/match.h"
#include "sphparam/correspondence/matched_files.h"
#include "sphparam/io/fillers.h"
#include "sphparam/parameterize.h"
#include "support/coil.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

MappedMesh mapped(TriangleMesh mesh) {
  SphereMap map = parameterize(mesh).map;
  MeshFile file;
  file.mesh = std::move(mesh);
  return MappedMesh({.file = std::move(file), .map = std::move(map)});
}

/// A ball with three bumps of different sizes: it has no symmetry.
TriangleMesh bumpy(int level) {
  TriangleMesh mesh = icosphere(level);
  const Vector3 bumps[] = {{1, 0.2, 0.1}, {-0.3, 1, 0.2}, {0.1, -0.4, 1}};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    double radius = 1, height = 0.9;
    for (const Vector3& bump : bumps) {
      radius += height * std::exp(-6 * (x - bump.normalized()).squaredNorm());
      height *= 0.6;
    }
    mesh.positions.row(v) = radius * x;
  }
  return mesh;
}

/// Evenly spread vertices of a mesh with themselves.
std::vector<LandmarkPair> with_itself(const TriangleMesh& mesh, int count) {
  std::vector<LandmarkPair> pairs;
  for (int i = 0; i < count; ++i) {
    const auto v = static_cast<Vertex>(i * mesh.vertex_count() / count);
    pairs.push_back({v, v});
  }
  return pairs;
}

double rms_between(const TriangleMesh& a, const TriangleMesh& b) {
  return std::sqrt((a.positions - b.positions).squaredNorm() /
                   static_cast<double>(a.vertex_count()));
}

double dirichlet(const SurfaceMap& map) {
  return summarise(measure_distortion(map)).symmetric_dirichlet;
}

TriangleMesh turned_copy(const TriangleMesh& mesh) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  return {mesh.positions * turn.transpose() * 3, mesh.triangles};
}

}  // namespace

TEST_CASE("match: a shape matched with itself is the identity") {
  const MappedMesh shape = mapped(bumpy(3));
  for (const int count : {1, 2, 5}) {
    const Match match =
        match_surfaces(shape, shape, {.landmarks = with_itself(shape.mesh(), count)});
    CHECK(dirichlet(match.map) == Approx(4).epsilon(1e-9));
    CHECK(rms_between(match.map.from_on_to(), shape.mesh()) < 1e-12);
  }
}

TEST_CASE("match: from coarse to fine, a shape finds its turned and scaled copy") {
  const MappedMesh shape = mapped(bumpy(4));
  // Another map of the copy: its own would fit at once.
  const TriangleMesh copy = turned_copy(shape.mesh());
  SphereMap map = parameterize(copy, {.energy = {.lambda = 10}}).map;
  MeshFile file;
  file.mesh = copy;
  const MappedMesh other({.file = std::move(file), .map = std::move(map)});
  const Match match = match_surfaces(shape, other, {.landmarks = with_itself(copy, 6)});
  CHECK(match.made_by == "coarse to fine");
  CHECK(dirichlet(match.map) < 4.04);
  CHECK(rms_between(match.map.from_on_to(), copy) < 0.03 * 3);
}

TEST_CASE("match: landmarks are exactly at their partners, and both maps are proved") {
  const MappedMesh a = mapped(bumpy(3)), b = mapped(random_sphere_mesh(700, 5));
  std::vector<LandmarkPair> pairs;
  for (Vertex v = 0; v < 4; ++v) {
    const auto from = static_cast<Vertex>(v * 150);
    Vertex nearest = 0;
    for (Vertex w = 0; w < b.mesh().vertex_count(); ++w) {
      const Vector3 x = a.mesh().position(from).normalized();
      if (b.mesh().position(w).normalized().dot(x) > b.mesh().position(nearest).normalized().dot(x))
        nearest = w;
    }
    pairs.push_back({from, nearest});
  }
  const Match match = match_surfaces(a, b, {.landmarks = pairs});
  CHECK(match.map.from().certificate().bijective());
  CHECK(match.map.to().map().points == b.map().points);
  const std::vector<SurfacePoint> forth = match.map.forth();
  for (size_t i = 0; i < pairs.size(); ++i) {
    CHECK(match.map.from().map().points.row(pairs[i].from) == b.map().points.row(pairs[i].to));
    CHECK(match.residuals[i] == 0);
    const Vector3 place = position(b.mesh(), forth[static_cast<size_t>(pairs[i].from)]);
    CHECK((place - b.mesh().position(pairs[i].to)).norm() < 1e-12);
  }
}

TEST_CASE("match: there and back is the identity to rounding") {
  const MappedMesh a = mapped(bumpy(3)), b = mapped(random_sphere_mesh(900, 6));
  const SurfaceMap map(a, b);
  const std::vector<SurfacePoint> forth = map.forth();
  Points directions(a.mesh().vertex_count(), 3);
  for (Vertex v = 0; v < directions.rows(); ++v) {
    const SurfacePoint& at = forth[static_cast<size_t>(v)];
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
      sum += at.barycentric[k] * b.map().point(b.mesh().triangles(at.face, k));
    directions.row(v) = sum;
  }
  const std::vector<SurfacePoint> back = a.locator().locate_all(directions);
  double worst = 0;
  for (Vertex v = 0; v < directions.rows(); ++v) {
    const Vector3 place = position(a.mesh(), back[static_cast<size_t>(v)]);
    worst = std::max(worst, (place - a.mesh().position(v)).norm());
  }
  CHECK(worst < 1e-11);
}

TEST_CASE("match: mirrored landmarks are refused, and are right for the mirror image") {
  const MappedMesh shape = mapped(bumpy(3));
  const MappedMesh mirrored = mirror_image(shape);
  const MatchOptions options{.landmarks = with_itself(shape.mesh(), 6)};
  CHECK_THROWS_AS(match_surfaces(mirrored, shape, options), MirroredLandmarks);
  const Match match = match_surfaces(mirror_image(mirrored), shape, options);
  CHECK(dirichlet(match.map) == Approx(4).epsilon(1e-9));
}

TEST_CASE("match: landmarks that say nothing of sides bring a warning, others none") {
  const auto ellipsoid = [](double x, double y, double z) {
    TriangleMesh mesh = icosphere(3);
    mesh.positions = mesh.positions * Vector3(x, y, z).asDiagonal();
    return mapped(std::move(mesh));
  };
  const MappedMesh from = ellipsoid(1, 1.6, 0.7), to = ellipsoid(1.2, 1, 0.8);
  std::vector<LandmarkPair> flat;  // in the plane of a symmetry of both
  for (Vertex v = 0; v < from.mesh().vertex_count() && flat.size() < 4; ++v)
    if (from.mesh().position(v).x() == 0) flat.push_back({v, v});
  REQUIRE(flat.size() == 4);
  const Match match = match_surfaces(from, to, {.landmarks = flat});
  REQUIRE(match.warnings.size() == 1);
  CHECK_THAT(match.warnings[0],
             Catch::Contains("the mirror image") && Catch::Contains("about as well"));
  const MappedMesh shape = mapped(bumpy(3)), other = mapped(bumpy(4));
  CHECK(match_surfaces(shape, other, {.landmarks = with_itself(shape.mesh(), 6)}).warnings.empty());
}

/// A ball with an arm, its tip vertex 0 of the icosphere.
TriangleMesh with_arm(int level, double length) {
  TriangleMesh mesh = icosphere(level);
  const Vector3 tip = mesh.position(0);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    mesh.positions.row(v) += length * std::exp(-20 * (x - tip).squaredNorm()) * tip;
  }
  return mesh;
}

TEST_CASE("match: an arm whose end is a landmark does not collapse, where all must, it is told") {
  const MappedMesh arm = mapped(with_arm(5, 3)), ball = mapped(icosphere(4));
  const std::vector<LandmarkPair> ends = {{0, 0}, {3, 3}, {5, 5}, {8, 8}};
  const Match onto_ball = match_surfaces(arm, ball, {.landmarks = ends});
  CHECK(summarise(measure_distortion(onto_ball.map)).area_ratio_p01 > 0.02);
  CHECK(onto_ball.warnings.empty());
  const MappedMesh long_arm = mapped(with_arm(5, 60));
  const Match squeezed = match_surfaces(long_arm, ball, {.landmarks = ends});
  REQUIRE(!squeezed.warnings.empty());
  CHECK_THAT(squeezed.warnings.back(), Catch::Contains("shrinks to less than 1/100"));
}

/// A ball with four arms, the last of them bent: it has ends and a front.
TriangleMesh armed(int level, double longer) {
  TriangleMesh mesh = icosphere(level);
  const TriangleMesh ball = mesh;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    double length = 1.5;
    for (const Vertex tip : {0, 3, 5, 8}) {
      const Vector3 axis = ball.position(tip);
      const double near = std::exp(-25 * (ball.position(v) - axis).squaredNorm());
      mesh.positions.row(v) += length * near * axis;
      length += longer;
    }
  }
  return mesh;
}

TEST_CASE("match: without landmarks ends find one another, and a turn does not matter") {
  const MappedMesh a = mapped(armed(4, 0.5)), b = mapped(turned_copy(armed(4, 0.55)));
  const Match match = match_surfaces(a, b, {.search = true});
  REQUIRE_FALSE(match.suggestions.empty());
  for (const LandmarkPair& pair : match.suggestions.front().landmarks) CHECK(pair.from == pair.to);
  CHECK(match.suggestions.front().agreement > 0.8);
  CHECK(match.confidence > 0.1);
  CHECK(match.residuals.empty());
  CHECK(match.map.from().certificate().bijective());
  const TriangleMesh moved = match.map.from_on_to();
  CHECK(rms_between(moved, b.mesh()) < 0.1);
}

TEST_CASE("match: of arms that are alike places in space tell which is which, if they may") {
  const MappedMesh a = mapped(armed(4, 0)), b = mapped(armed(3, 0.001));
  const Match anyhow = match_surfaces(a, b, {.search = true});
  CHECK(anyhow.confidence < 0.15);
  REQUIRE_FALSE(anyhow.warnings.empty());
  CHECK_THAT(anyhow.warnings[0], Catch::Contains("say --alike if both lie alike in space"));
  const Match match = match_surfaces(a, b, {.search = true, .alike = true});
  REQUIRE_FALSE(match.suggestions.empty());
  for (const LandmarkPair& pair : match.suggestions.front().landmarks) CHECK(pair.from == pair.to);
  CHECK(match.suggestions.front().place_agreement > 0.95);
  CHECK(match.confidence > 0.5);
  CHECK(match.warnings.empty());
  CHECK(rms_between(match.map.from_on_to(), a.mesh()) < 0.1);
}

TEST_CASE("match: places in space count from the centre, in units of the size") {
  const MappedMesh a = mapped(armed(4, 0));
  TriangleMesh far_away = armed(3, 0.001);
  far_away.positions = (100 * far_away.positions).rowwise() + Eigen::RowVector3d(1e4, -3e4, 5e3);
  const Match match = match_surfaces(a, mapped(far_away), {.search = true, .alike = true});
  REQUIRE_FALSE(match.suggestions.empty());
  for (const LandmarkPair& pair : match.suggestions.front().landmarks) CHECK(pair.from == pair.to);
  CHECK(match.suggestions.front().place_agreement > 0.95);
}

TEST_CASE("match: without landmarks a shape matched with itself is the identity") {
  const MappedMesh a = mapped(armed(4, 0.5));
  const Match match = match_surfaces(a, a, {.search = true});
  CHECK(rms_between(match.map.from_on_to(), a.mesh()) < 1e-12);
}

TEST_CASE(
    "match: a ball without landmarks stays on itself, and landmarks are not searched for beside "
    "given ones") {
  const MappedMesh ball = mapped(icosphere(4));
  CHECK(dirichlet(match_surfaces(ball, ball, {.search = true}).map) == Approx(4).epsilon(1e-9));
  CHECK_THROWS_AS(match_surfaces(ball, ball, {.landmarks = {{0, 0}}, .search = true}),
                  std::invalid_argument);
}

TEST_CASE("match: a turn for want of ends that is no isometry is told, and little trusted") {
  const MappedMesh one = mapped(coil(1)), two = mapped(coil(2));
  const Match match = match_surfaces(one, two, {.search = true});
  CHECK(match.suggestions.empty());
  REQUIRE(match.made_by == "turn");
  CHECK(match.confidence <= Approx(0.05 / (match.energy / 2 - 1)));
  const auto told = [](const Match& found) {
    return std::ranges::count_if(found.warnings, [](const std::string& warning) {
      return warning.starts_with(
                 "nothing but a turn of the maps was found (neither has three "
                 "ends), and it distorts (energy ") &&
             warning.ends_with("`sphparam match --landmarks`");
    });
  };
  CHECK(told(match) == 1);
  CHECK(told(match_surfaces(one, one, {.search = true})) == 0);
}

TEST_CASE("match: a start that was thrown away is neither told nor doubted") {
  // The turn is off by little, and distorts: the map of its own is the identity.
  const MappedMesh bent = mapped(coil(1));
  const Match match = match_surfaces(bent, bent, {.search = true, .alike = true});
  CHECK(match.made_by == "own map");
  CHECK(match.energy == Approx(2).epsilon(1e-6));
  CHECK(match.confidence > 0.5);
  CHECK(match.warnings.empty());
}

TEST_CASE("match: surfaces that lie alike begin where they are nearest, if that distorts less") {
  const MappedMesh one = mapped(coil(1));
  TriangleMesh moved = coil(1);
  moved.positions.col(0).array() += 0.001;
  SphereMap map = parameterize(moved, {.energy = {.lambda = 20}}).map;
  MeshFile file;
  file.mesh = std::move(moved);
  const MappedMesh other({.file = std::move(file), .map = std::move(map)});
  const Match anyhow = match_surfaces(one, other, {.search = true});
  const Match alike = match_surfaces(one, other, {.search = true, .alike = true, .threads = 1});
  CHECK(anyhow.made_by == "turn");
  CHECK(alike.made_by == "places");
  CHECK(alike.energy < anyhow.energy);
  const Match again = match_surfaces(one, other, {.search = true, .alike = true, .threads = 2});
  CHECK(again.map.from().map().points == alike.map.from().map().points);
}

TEST_CASE("match: the same bits for one thread and two") {
  const MappedMesh a = mapped(bumpy(4)), b = mapped(turned_copy(bumpy(3)));
  std::vector<LandmarkPair> pairs;
  for (Vertex v = 0; v < 12; v += 3) pairs.push_back({v, v});  // vertices of the icosahedron
  const Match one = match_surfaces(a, b, {.landmarks = pairs, .threads = 1});
  const Match two = match_surfaces(a, b, {.landmarks = pairs, .threads = 2});
  CHECK(one.map.from().map().points == two.map.from().map().points);
  CHECK(one.energy == two.energy);
}

TEST_CASE("match: too many vertices for a factor find their turned copy too, on any threads") {
  const MappedMesh shape = mapped(bumpy(5));  // 10,242 of them
  const TriangleMesh copy = turned_copy(shape.mesh());
  SphereMap map = parameterize(copy, {.energy = {.lambda = 10}}).map;
  MeshFile file;
  file.mesh = copy;
  const MappedMesh other({.file = std::move(file), .map = std::move(map)});
  const std::vector<LandmarkPair> pairs = with_itself(copy, 6);
  const Match one = match_surfaces(shape, other, {.landmarks = pairs, .threads = 1});
  const Match two = match_surfaces(shape, other, {.landmarks = pairs, .threads = 2});
  CHECK(one.map.from().map().points == two.map.from().map().points);
  CHECK(dirichlet(one.map) < 4.04);
  CHECK(rms_between(one.map.from_on_to(), copy) < 0.03 * 3);
}

TEST_CASE("match: random pairs of random spheres are certified whatever their landmarks") {
  std::mt19937 random(7);
  int matched = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    const MappedMesh a = mapped(random_sphere_mesh(8 + static_cast<int>(random() % 50), seed));
    const MappedMesh b =
        mapped(random_sphere_mesh(8 + static_cast<int>(random() % 50), seed + 5000));
    std::vector<LandmarkPair> pairs;
    for (Vertex v = 0; v < static_cast<Vertex>(random() % 5); ++v) pairs.push_back({v * 2, v * 2});
    try {
      const Match match = match_surfaces(a, b, {.landmarks = pairs});
      CHECK(match.map.from().certificate().bijective());
      for (const double residual : match.residuals) CHECK(residual == 0);
      ++matched;
    } catch (const MirroredLandmarks&) {
    } catch (const UnreachableLandmarks&) {
    }
  }
  CHECK(matched > 500);
}

TEST_CASE(
    "match: a surface that is inside out beside one that is not is told, alike ones are not") {
  const auto named = [](TriangleMesh mesh, const char* name) {
    SphereMap map = parameterize(mesh).map;
    MeshFile file;
    file.mesh = std::move(mesh);
    return MappedMesh({.file = std::move(file), .map = std::move(map), .name = name});
  };
  TriangleMesh turned = bumpy(3);
  turned.triangles.col(1).swap(turned.triangles.col(2));
  const MappedMesh out = named(bumpy(3), "out.ply"), in = named(turned, "in.vtp"),
                   high = named({turned.positions * 1e75, turned.triangles}, "high.vtp");
  const std::string told =
      "in.vtp is inside out and out.ply is not, so that the map between them mirrors: "
      "--repair=orientation turns it over";
  const MatchOptions options{.landmarks = with_itself(out.mesh(), 1)};
  CHECK(match_surfaces(out, in, options).warnings.at(0) == told);
  CHECK(match_surfaces(in, out, options).warnings.at(0) == told);
  CHECK_THAT(match_surfaces(out, high, options).warnings.at(0),
             Catch::StartsWith("high.vtp is inside out and out.ply is not"));
  CHECK(match_surfaces(in, in, options).warnings.empty());
  CHECK(match_surfaces(out, out, options).warnings.empty());
  const MatchOptions many{.landmarks = with_itself(out.mesh(), 8)};
  CHECK_THROWS_WITH(
      match_surfaces(in, out, many),
      Catch::StartsWith("the landmarks look mirrored") && Catch::EndsWith("; " + told));
}

TEST_CASE("match: which side of a sheet is out its file says, and nobody is told otherwise") {
  const auto half_filled = [](TriangleMesh mesh) {
    SphereMap map = parameterize(mesh).map;
    FillerMarks fillers;
    for (const auto& face : mesh.triangles.rowwise())
      fillers.push_back(mesh.position(face[0]).z() < 0 ? 1 : 0);
    MeshFile file;
    file.mesh = std::move(mesh);
    mark_fillers(file, fillers);
    return MappedMesh({.file = std::move(file), .map = std::move(map), .name = "sheet"});
  };
  TriangleMesh turned = bumpy(3);
  turned.triangles.col(1).swap(turned.triangles.col(2));
  const MappedMesh one = half_filled(bumpy(3)), other = half_filled(turned);
  for (const std::string& warning :
       match_surfaces(one, other, {.landmarks = with_itself(one.mesh(), 1)}).warnings)
    CHECK_THAT(warning, !Catch::Contains("inside out"));
}

TEST_CASE("match: the distortion of the identity is none") {
  const MappedMesh shape = mapped(bumpy(3));
  const DistortionSummary d = summarise(measure_distortion(SurfaceMap(shape, shape)));
  CHECK(d.symmetric_dirichlet == Approx(4).epsilon(1e-9));
  CHECK(d.mean_abs_ln_area < 1e-9);
  CHECK(d.mean_abs_ln_angle < 1e-9);
}

TEST_CASE("match: landmarks that are no vertices, or one twice, are refused") {
  const MappedMesh shape = mapped(icosphere(1));
  CHECK_THROWS_AS(match_surfaces(shape, shape, {.landmarks = {{0, 99}}}), std::invalid_argument);
  CHECK_THROWS_AS(match_surfaces(shape, shape, {.landmarks = {{0, 1}, {0, 2}}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(match_surfaces(shape, shape, {.landmarks = {{0, 1}, {2, 1}}}),
                  std::invalid_argument);
}

}  // namespace sphparam::tests
