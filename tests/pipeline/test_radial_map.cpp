#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "embedding/constructions/gnomonic.h"
#include "embedding/frame/nearest_rotation.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/radial_directions.h"
#include "support/test_meshes.h"

// Maps that lie as the body does: the directions from its centre where these are a map, the nearest
// rotation to them where it is made otherwise.

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Star-shaped about the origin: an ellipsoid with bumps, like a small body.
TriangleMesh bumpy(int level) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    const double r = 1 + 0.15 * std::sin(4 * x.x()) * std::cos(3 * x.y() + 1) + 0.1 * x.z();
    mesh.positions.row(v) = r * Vector3(1.6 * x.x(), x.y(), 0.8 * x.z());
  }
  return mesh;
}

/// A vertex that lies beyond its neighbour as seen from the origin: some triangles fold there.
Vertex push_beyond_neighbour(TriangleMesh& mesh) {
  const Vertex v = mesh.triangles(40, 0), neighbour = mesh.triangles(40, 1);
  mesh.positions.row(v) += 1.6 * (mesh.position(neighbour) - mesh.position(v));
  return v;
}

Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(1.9, Vector3(3, -1, 2).normalized()).toRotationMatrix();
}

double rms_between(const TriangleMesh& mesh, const SphereMap& a, const SphereMap& b) {
  return rms_angle(a, b, vertex_areas(Topology(mesh), measure_source(mesh)));
}

}  // namespace

TEST_CASE("radial: where the body is star-shaped the map is its directions, bit for bit") {
  const TriangleMesh mesh = bumpy(4);
  const Parameterization result = parameterize(mesh, {.method = Method::Radial});
  CHECK(result.certificate.bijective());
  CHECK(result.map.points == radial_directions(mesh).points);
  CHECK(result.made_by == "radial projection");
  CHECK_FALSE(result.poles);
  REQUIRE(result.radial);
  CHECK(result.radial->folds == 0);
  CHECK(result.radial->moved == 0);
  CHECK(result.radial->largest_movement == 0);
}

TEST_CASE("radial: what folds is untangled there, told with its shares, all else stays") {
  TriangleMesh mesh = bumpy(4);
  push_beyond_neighbour(mesh);
  const SphereMap directions = radial_directions(mesh);
  const Certificate folded = certify(Topology(mesh), directions);
  REQUIRE(folded.fold_count() > 0);
  const Parameterization result = parameterize(mesh, {.method = Method::Radial});
  CHECK(result.certificate.bijective());
  CHECK(result.made_by == "untangling");
  REQUIRE(result.radial);
  CHECK(result.radial->folds == folded.fold_count());
  CHECK(result.radial->folded_area > 0);
  CHECK(result.radial->folded_area < 0.01);
  long moved = 0;
  double farthest = 0;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const double way = (result.map.point(v) - directions.point(v)).norm();
    moved += way > 0;
    farthest = std::max(farthest, 2 * std::asin(way / 2));
  }
  CHECK(moved > 0);
  CHECK(result.radial->moved ==
        Approx(static_cast<double>(moved) / static_cast<double>(mesh.vertex_count())));
  CHECK(result.radial->moved < 0.05);
  CHECK(result.radial->largest_movement == Approx(farthest));
  CHECK(result.radial->largest_movement < 0.3);
}

TEST_CASE("radial: fillers that fold give way, the surface stays") {
  // The faces about a vertex close a hole; the vertex lies where they fold.
  TriangleMesh mesh = bumpy(4);
  const Vertex v = push_beyond_neighbour(mesh);
  FillerMarks fillers(static_cast<size_t>(mesh.face_count()), 0);
  for (Face f = 0; f < mesh.face_count(); ++f)
    fillers[static_cast<size_t>(f)] = (mesh.triangles.row(f).array() == v).any();
  const SphereMap directions = radial_directions(mesh);
  REQUIRE(certify(Topology(mesh), directions).fold_count() > 0);
  const Parameterization result =
      parameterize(mesh, {.method = Method::Radial, .fillers = fillers, .filler_share = 0.1});
  CHECK(result.certificate.bijective());
  CHECK(result.radial->folds == 0);
  CHECK(result.radial->folded_area == 0);
  CHECK(result.radial->moved == 0);
  CHECK(result.radial->largest_movement == 0);
  for (Vertex w = 0; w < mesh.vertex_count(); ++w)
    CHECK((result.map.point(w) == directions.point(w)) == (w != v));
}

TEST_CASE("radial: fillers that fold give way however many they are") {
  // A cap closes a hole, and lies in it the other way round.
  TriangleMesh mesh = bumpy(3);
  const TriangleMesh sphere = icosphere(3);
  FillerMarks fillers(static_cast<size_t>(mesh.face_count()), 0);
  std::vector<char> of_surface(static_cast<size_t>(mesh.vertex_count()), 0);
  for (Face f = 0; f < mesh.face_count(); ++f) {
    double height = 0;
    for (int k = 0; k < 3; ++k) height += sphere.positions(mesh.triangles(f, k), 2) / 3;
    fillers[static_cast<size_t>(f)] = height > 0.3;
    for (int k = 0; height <= 0.3 && k < 3; ++k)
      of_surface[static_cast<size_t>(mesh.triangles(f, k))] = 1;
  }
  for (Vertex v = 0; v < mesh.vertex_count(); ++v)
    if (!of_surface[static_cast<size_t>(v)]) mesh.positions(v, 0) *= -1;
  const SphereMap directions = radial_directions(mesh);
  const Certificate folded = certify(Topology(mesh), directions);
  REQUIRE(folded.fold_count() > 0.2 * mesh.face_count());
  const Parameterization result =
      parameterize(mesh, {.method = Method::Radial, .fillers = fillers, .filler_share = 0.1});
  CHECK(result.certificate.bijective());
  CHECK_FALSE(result.made_anew);
  CHECK(result.radial->moved == 0);
}

TEST_CASE("radial: a body that hangs over everywhere is mapped anew, turned to its directions") {
  const TriangleMesh mesh = random_sphere_mesh(400, 3);
  const Parameterization result = parameterize(mesh, {.method = Method::Radial});
  CHECK(result.certificate.bijective());
  CHECK(result.made_by != "untangling");
  const SphereMap directions = radial_directions(mesh);
  const VectorX areas = vertex_areas(Topology(mesh), measure_source(mesh));
  const Eigen::Matrix3d left = nearest_rotation(result.map.points, directions.points, areas);
  CHECK((left - Eigen::Matrix3d::Identity()).norm() < 1e-9);
  CHECK(result.radial->moved > 0.9);
}

TEST_CASE("radial: directions are those from the centre, of positions of any size") {
  const TriangleMesh mesh = bumpy(2);
  const SphereMap plain = parameterize(mesh, {.method = Method::Radial}).map;
  const Vector3 centre(0.1, -0.05, 0.2);
  TriangleMesh moved = mesh;
  moved.positions.rowwise() += centre.transpose();
  const Parameterization about = parameterize(moved, {.method = Method::Radial, .centre = centre});
  CHECK((about.map.points - plain.points).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(about.radial->centre == centre);
  for (const int exponent : {-900, -500, 500, 1000}) {
    TriangleMesh scaled = mesh;
    scaled.positions *= std::ldexp(1.0, exponent);
    CHECK(parameterize(scaled, {.method = Method::Radial}).map.points == plain.points);
  }
}

TEST_CASE("radial: a vertex at the centre and other frames are refused by name, before any work") {
  const TriangleMesh mesh = bumpy(2);
  const auto at_centre = [&] {
    parameterize(mesh, {.method = Method::Radial, .centre = mesh.position(17)});
  };
  CHECK_THROWS_AS(at_centre(), VertexAtCentre);
  CHECK_THROWS_WITH(at_centre(), Catch::Contains("vertex 17"));
  const auto refused = [&](ParameterizeOptions options) {
    CHECK_THROWS_AS(parameterize(mesh, options), std::invalid_argument);
  };
  const SphereMap directions = radial_directions(mesh);
  refused({.method = Method::Radial, .poles = Poles{3, 9}});
  refused({.method = Method::Radial, .meridian = 3});
  refused({.method = Method::Radial, .pins = {{3, {1, 1}}}});
  refused({.method = Method::Radial, .align_to = directions});
  refused({.poles = Poles{3, 9}, .align_to = directions});
  refused({.align_to = SphereMap{directions.points.topRows(5)}});
  SphereMap without_ray = directions;
  without_ray.points.row(7).setZero();
  refused({.align_to = without_ray});
}

TEST_CASE("align_to: a map is turned to directions as one piece, and the angle left is told") {
  const TriangleMesh mesh = bumpy(4);
  const SphereMap directions = radial_directions(mesh);
  const Parameterization free = parameterize(mesh, {.automatic_poles = false});
  const Parameterization aligned = parameterize(mesh, {.align_to = directions});
  CHECK(aligned.certificate.bijective());
  CHECK_FALSE(aligned.poles);
  REQUIRE(aligned.alignment);
  CHECK(*aligned.alignment == Approx(rms_between(mesh, aligned.map, directions)));
  CHECK(*aligned.alignment < 0.3);  // a map of little distortion lies near the directions
  const VectorX areas = vertex_areas(Topology(mesh), measure_source(mesh));
  const Eigen::Matrix3d rotation = nearest_rotation(free.map.points, aligned.map.points, areas);
  CHECK(rms_between(mesh, turned(free.map, rotation), aligned.map) < 1e-12);
}

TEST_CASE("align_to: the same map turned comes back to where it was") {
  const TriangleMesh mesh = bumpy(3);
  const SphereMap there = turned(parameterize(mesh).map, some_rotation());
  const Parameterization back = repair_map(mesh, parameterize(mesh).map, {.align_to = there});
  CHECK(*back.alignment < 1e-12);
  CHECK(rms_between(mesh, back.map, there) < 1e-12);
}

TEST_CASE("repair_map: what is embedded anew lies as the given map did") {
  const TriangleMesh mesh = bumpy(4);
  SphereMap given = turned(radial_directions(mesh), some_rotation());
  for (Vertex v = 0; v < mesh.vertex_count(); v += 3) {  // folds everywhere: nothing to untangle
    given.points.row(v) += 0.25 * Vector3(std::sin(v), std::cos(3.0 * v), std::sin(5.0 * v));
  }
  const Parameterization result = repair_map(mesh, given);
  CHECK(result.certificate.bijective());
  CHECK(result.made_by == "progressive embedding");
  const VectorX areas = vertex_areas(Topology(mesh), measure_source(mesh));
  const Eigen::Matrix3d left =
      nearest_rotation(result.map.points, normalised(given.points).points, areas);
  CHECK((left - Eigen::Matrix3d::Identity()).norm() < 1e-9);
  CHECK(rms_between(mesh, result.map, given) < 0.4);
}

TEST_CASE("radial and align_to: the same bytes for 1, 2 and 4 threads") {
  TriangleMesh mesh = bumpy(4);
  push_beyond_neighbour(mesh);
  const SphereMap directions = radial_directions(mesh);
  const ParameterizeOptions radial{.method = Method::Radial, .threads = 1};
  const ParameterizeOptions aligned{.align_to = directions, .threads = 1};
  for (const ParameterizeOptions& options : {radial, aligned}) {
    const SphereMap one = parameterize(mesh, options).map;
    for (const int threads : {2, 4}) {
      ParameterizeOptions more = options;
      more.threads = threads;
      CHECK(parameterize(mesh, more).map.points == one.points);
    }
  }
}
