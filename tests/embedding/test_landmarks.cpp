#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "embedding/constructions/progressive.h"
#include "embedding/frame/landmarks.h"
#include "folded_maps.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/orientation.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Points near the images of some vertices, `away` radians or so, in a turned frame.
std::vector<Pin> pins_near(const SphereMap& map, int count, double away, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return 2.0 * static_cast<double>(random()) / 4294967296.0 - 1; };
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Pin> pins;
  for (int i = 0; i < count; ++i) {
    const Vertex v = static_cast<Vertex>(i * (map.points.rows() / count));
    const Vector3 noise(number(), number(), number());
    pins.push_back({v, (turn * map.point(v) + away * noise).normalized()});
  }
  return pins;
}

}  // namespace

TEST_CASE("best_rotation: finds the rotation that was applied, never a reflection") {
  const SphereMap map{icosphere(2).positions};
  const std::vector<Pin> pins = pins_near(map, 6, 0, 1);
  const Eigen::Matrix3d rotation = best_rotation(map, pins);
  for (const Pin& pin : pins) CHECK((rotation * map.point(pin.vertex) - pin.point).norm() < 1e-14);
  std::vector<Pin> mirrored;
  for (const Vertex v : {0, 10, 20, 30}) mirrored.push_back({v, -map.point(v)});
  CHECK(best_rotation(map, mirrored).determinant() == Approx(1));
}

TEST_CASE("pin_residuals: 0 exactly where all bits agree") {
  const SphereMap map{icosphere(1).positions};
  const Vector3 x = map.point(3);
  const Vector3 close(x.x(), std::nextafter(x.y(), 9.0), x.z());
  const std::vector<double> residuals = pin_residuals(map, {{3, x}, {3, close}, {3, -x}});
  CHECK(residuals[0] == 0);
  CHECK(residuals[1] > 0);
  CHECK(residuals[2] == Approx(3.14159265));
  CHECK_FALSE(all_exact(residuals));
  CHECK_FALSE(all_exact({}));
}

TEST_CASE("place_landmarks: pins end at their points, bit by bit, and nothing folds") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  for (const double away : {0.0, 0.1, 0.4}) {
    const std::vector<Pin> pins = pins_near({mesh.positions}, 10, away, 7);
    const LandmarkPlacement placed = place_landmarks(topology, source, {mesh.positions}, pins);
    CHECK(placed.exact());
    for (const Pin& pin : pins) CHECK(placed.map.point(pin.vertex) == pin.point);
    CHECK(certify(topology, placed.map).bijective());
  }
}

TEST_CASE("place_landmarks: two pins that change places go round each other") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const SphereMap map{mesh.positions};
  // Four more hold the sphere so that turning it over does not do it.
  std::vector<Pin> pins;
  for (const Vector3& x :
       {Vector3(0, 1, 0), Vector3(0, -1, 0), Vector3(0, 0, -1), Vector3(-1, 0, 0)}) {
    Eigen::Index v = 0;
    (mesh.positions * x).maxCoeff(&v);
    pins.push_back({static_cast<Vertex>(v), map.point(static_cast<Vertex>(v))});
  }
  Eigen::Index a = 0, b = 0;
  (mesh.positions * Vector3(1, 0, 0.5)).maxCoeff(&a);
  (mesh.positions * Vector3(0.5, 0, 1)).maxCoeff(&b);
  const Vertex v = static_cast<Vertex>(a), w = static_cast<Vertex>(b);
  pins.push_back({v, map.point(w)});
  pins.push_back({w, map.point(v)});
  const LandmarkPlacement placed = place_landmarks(topology, measure_source(mesh), map, pins);
  CHECK(placed.exact());
  CHECK(certify(topology, placed.map).bijective());
}

TEST_CASE("place_landmarks: neighbours asked to be opposite stop on the way, nothing folds") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const Vertex v = 20, w = topology.target(topology.outgoing(20));
  const std::vector<Pin> pins{{v, Vector3::UnitZ()}, {w, -Vector3::UnitZ()}};
  const LandmarkPlacement placed =
      place_landmarks(topology, measure_source(mesh), {mesh.positions}, pins);
  CHECK_FALSE(placed.exact());
  CHECK(placed.residuals == pin_residuals(placed.map, pins));
  CHECK(certify(topology, placed.map).bijective());
}

TEST_CASE("place_landmarks: no more rounds are told than were made") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const Vertex v = 20, w = topology.target(topology.outgoing(20));
  const std::vector<Pin> pins{{v, Vector3::UnitZ()}, {w, -Vector3::UnitZ()}};
  for (const int most : {0, 3}) {
    const LandmarkPlacement placed = place_landmarks(topology, measure_source(mesh),
                                                     {mesh.positions}, pins, {.most_rounds = most});
    CHECK_FALSE(placed.exact());
    CHECK(placed.rounds == most);
  }
}

TEST_CASE("place_landmarks: a pin that rounding keeps from its point stays beside it") {
  // Two units in the last place from each other: (to − (from·to) from) is 0, their product is not.
  const Vector3 from(-0x1.066695967123fp-2, -0x1.00b96cd0e44e8p-1, -0x1.a71c77da02a1fp-1);
  const Vector3 to(-0x1.066695967123dp-2, -0x1.00b96cd0e44e6p-1, -0x1.a71c77da02a1dp-1);
  REQUIRE((to - from.dot(to) * from).norm() == 0);
  REQUIRE(from.cross(to).norm() > 0);
  // On the side ab of a triangle abc whose other corner is d: the vertex v is inside it at `from`
  // and outside at `to`.
  Vector3 a = Vector3::Zero(), b = a;
  const Vector3 middle = Vector3(-1, -1, -1).normalized();
  const Vector3 aside = from.cross(middle).normalized();
  for (int i = 1; i < 100'000 && (orientation(from, a, b) <= 0 || orientation(to, a, b) > 0); ++i) {
    const double angle = 1 + 1e-5 * i;
    a = (std::cos(angle) * from + std::sin(angle) * aside).normalized();
    b = (std::cos(angle) * from - std::sin(angle) * aside).normalized();
  }
  REQUIRE(orientation(from, a, b) > 0);
  REQUIRE(orientation(to, a, b) <= 0);
  TriangleMesh mesh;
  mesh.triangles.resize(6, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3, 0, 3, 1, 2, 1, 4, 3, 2, 4, 1, 3, 4;
  mesh.positions.resize(5, 3);
  const Vector3 c = (middle + 0.8 * (middle - from.dot(middle) * from).normalized()).normalized();
  const Vector3 d = -(a + b + c).normalized();
  mesh.positions << from.transpose(), a.transpose(), b.transpose(), c.transpose(), d.transpose();
  const Topology topology(mesh);
  const SphereMap map{mesh.positions};
  REQUIRE(certify(topology, map).bijective());
  const LandmarkPlacement placed =
      place_landmarks(topology, measure_source(mesh), map, {{4, d}, {0, to}}, {.most_rounds = 2});
  CHECK(placed.map.points.allFinite());
  CHECK(placed.residuals[1] < 1e-15);
  CHECK(certify(topology, placed.map).bijective());
}

TEST_CASE("place_landmarks: without a pin nothing moves, and nothing is said to be exact") {
  const TriangleMesh mesh = icosphere(1);
  const LandmarkPlacement placed =
      place_landmarks(Topology(mesh), measure_source(mesh), {mesh.positions}, {});
  CHECK(placed.map.points == mesh.positions);
  CHECK(placed.rounds == 0);
  CHECK_FALSE(placed.exact());
}

TEST_CASE("place_landmarks: can be cancelled before it has moved anything far") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const std::vector<Pin> pins = pins_near({mesh.positions}, 8, 0.4, 3);
  int told = 0;
  const auto cancel = [&](std::string_view, double) { return ++told < 2; };
  CHECK_THROWS_AS(
      place_landmarks(topology, measure_source(mesh), {mesh.positions}, pins, {.progress = cancel}),
      Cancelled);
  CHECK(told == 2);
}

TEST_CASE("face_folded_by: the triangle whose pinned corners are clockwise or in line") {
  const TriangleMesh mesh = icosphere(1);
  const Topology topology(mesh);
  const Face f = 17;
  std::vector<Pin> pins;
  for (int k = 0; k < 3; ++k) {
    const Vertex v = topology.vertex(f, k);
    pins.push_back({v, mesh.position(v).normalized()});
  }
  CHECK_FALSE(face_folded_by(topology, pins));
  std::swap(pins[0].point, pins[1].point);
  CHECK(face_folded_by(topology, pins) == f);
  CHECK_FALSE(face_folded_by(topology, {pins[0], pins[1]}));
  pins[2].point = pins[1].point;
  CHECK(face_folded_by(topology, pins) == f);
}

TEST_CASE("place_landmarks: the same bits for any number of threads") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const std::vector<Pin> pins = pins_near({mesh.positions}, 8, 0.3, 3);
  const auto one = place_landmarks(topology, source, {mesh.positions}, pins, {.threads = 1});
  const auto three = place_landmarks(topology, source, {mesh.positions}, pins, {.threads = 3});
  CHECK(one.map.points == three.map.points);
}

TEST_CASE("embed_progressively: pins are exact on meshes finer than the level that places them") {
  for (const unsigned seed : {1u, 2u}) {
    const TriangleMesh mesh = random_sphere_mesh(2000, seed);
    const Topology topology(mesh);
    const SphereMap free = *embed_progressively(mesh, topology).map;
    const std::vector<Pin> pins = pins_near(free, 10, 0.2, seed);
    const ProgressiveEmbedding held = embed_progressively(mesh, topology, {.pins = pins});
    REQUIRE(held.map);
    CHECK(held.report.pin_residuals == pin_residuals(*held.map, pins));
    CHECK(all_exact(held.report.pin_residuals));
    CHECK(certify(topology, *held.map).bijective());
  }
}

TEST_CASE("build_hierarchy: kept vertices stay while a level has more than the given number") {
  const TriangleMesh mesh = icosphere(4);
  const MeshHierarchy hierarchy =
      build_hierarchy(mesh, Topology(mesh), 0, {.vertices = {3, 500, 2561}, .until = 200});
  std::vector<Vertex> names{3, 500, 2561};
  for (size_t l = 1; hierarchy[l - 1].vertex_count() > 200; ++l) {
    for (Vertex& v : names) {
      const Vertex coarse = coarser_name(hierarchy[l], v);
      REQUIRE(coarse >= 0);
      CHECK(hierarchy[l].finer[static_cast<size_t>(coarse)] == v);
      v = coarse;
    }
  }
  CHECK(hierarchy.back().vertex_count() == 4);
}

TEST_CASE("triangle_mesh: a level's triangles are its rings'") {
  const TriangleMesh mesh = icosphere(2);
  MeshHierarchy hierarchy = build_hierarchy(mesh, Topology(mesh));
  for (size_t l = hierarchy.size(); l-- > 0;) {
    HierarchyLevel& level = hierarchy[l];
    if (l + 1 < hierarchy.size()) complete_positions(level, hierarchy[l + 1]);
    const TriangleMesh coarse = triangle_mesh(level);
    const Topology topology(coarse);  // throws unless closed, oriented and manifold
    CHECK(topology.vertex_count() == level.vertex_count());
    for (Vertex v = 0; v < level.vertex_count(); ++v) {
      CHECK(topology.valence(v) == level.valence(v));
      CHECK(topology.find_halfedge(v, level.ring_begin(v)[0]) >= 0);
    }
  }
}

TEST_CASE("parameterize: pinned vertices have the coordinates that were asked for") {
  const TriangleMesh mesh = icosphere(3);
  const Parameterization free = parameterize(mesh, {.automatic_poles = false});
  std::vector<Landmark> landmarks;
  for (const Pin& pin : pins_near(free.map, 10, 0.15, 11)) {
    landmarks.push_back({pin.vertex, to_spherical(pin.point)});
  }
  const Parameterization result = parameterize(mesh, {.pins = landmarks});
  REQUIRE(result.certificate.bijective());
  CHECK(all_exact(result.pin_residuals));
  for (const Landmark& landmark : landmarks) {
    CHECK(result.map.point(landmark.vertex) == to_cartesian(landmark.coordinates));
    const SphericalCoordinates got = to_spherical(result.map.point(landmark.vertex));
    CHECK(got.theta == Approx(landmark.coordinates.theta).epsilon(1e-14));
    CHECK(got.phi == Approx(landmark.coordinates.phi).epsilon(1e-14));
  }
}

TEST_CASE("parameterize: pins that cannot be met leave a valid map and their residuals") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  // A vertex in the middle of its ring, the ring run through the wrong way.
  std::vector<Landmark> pins{{30, {0.0, 1.5}}};
  topology.for_each_outgoing(30, [&](Halfedge h) {
    const double turn = static_cast<double>(pins.size());  // θ east, ϕ south: clockwise
    pins.push_back({topology.target(h), {3 + 0.3 * std::cos(turn), 1.5 + 0.3 * std::sin(turn)}});
  });
  pins[0].coordinates.theta = 3;
  const Parameterization result = parameterize(mesh, {.pins = pins});
  CHECK(result.certificate.bijective());
  REQUIRE(result.pin_residuals.size() == pins.size());
  CHECK_FALSE(all_exact(result.pin_residuals));
}

TEST_CASE("parameterize: every vertex may be pinned, where it is") {
  const TriangleMesh mesh = octahedron();
  std::vector<Landmark> pins;
  for (Vertex v = 0; v < 6; ++v) pins.push_back({v, to_spherical(mesh.position(v).normalized())});
  const Parameterization result = parameterize(mesh, {.pins = pins});
  CHECK(result.certificate.bijective());
  REQUIRE(result.pin_residuals.size() == 6);
}

TEST_CASE("parameterize: poles of a mesh that is its own coarsest level") {
  const Parameterization result = parameterize(octahedron(), {.poles = Poles{0, 1}});
  CHECK(result.certificate.bijective());
}
