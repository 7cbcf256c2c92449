#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "embedding/constructions/progressive.h"
#include "embedding/frame/pole_placement.h"
#include "folded_maps.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/rotation.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

const Vector3 up(0, 0, 1), down(0, 0, -1);

struct Embedded {
  explicit Embedded(TriangleMesh m)
      : mesh(std::move(m)),
        topology(mesh),
        source(measure_source(mesh)),
        map(*embed_progressively(mesh, topology).map) {}

  TriangleMesh mesh;
  Topology topology;
  RestTriangles source;
  SphereMap map;
};

bool mentions(const std::vector<std::string>& warnings, const std::string& word) {
  for (const std::string& warning : warnings) {
    if (warning.find(word) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("place_poles_on_axis: exact poles near the axis, certified, at next to no cost") {
  const Embedded e(tube(12, 8));
  for (const Vector3& axis : {Vector3(0, 0, 1), Vector3(1, -1, 0.3), Vector3(-2, 0, 1)}) {
    const auto placed = place_poles_on_axis(e.topology, e.source, e.map, axis);
    REQUIRE(placed);
    CHECK(placed->map.point(placed->north) == up);
    CHECK(placed->map.point(placed->south) == down);
    CHECK(certify(e.topology, placed->map).bijective());
    const std::vector<Vertex> near = nearest_vertices(e.map, axis, 32);
    CHECK(std::ranges::count(near, placed->north) == 1);
    CHECK(placed->energy_after < 1.02 * placed->energy_before);
    CHECK(placed->energy_after ==
          Approx(distortion_energy(e.topology, e.source, placed->map, {})).epsilon(1e-9));
  }
}

TEST_CASE("place_poles: the poles of a map can change places, though one is at -z exactly") {
  const Embedded e(tube(12, 8));
  const auto placed = place_poles_on_axis(e.topology, e.source, e.map, {0, 0, 1});
  REQUIRE(placed);
  for (const bool turned : {false, true}) {
    const Vertex north = turned ? placed->south : placed->north,
                 south = turned ? placed->north : placed->south;
    const auto again = place_poles(e.topology, e.source, placed->map, north, south, {.sweeps = 0});
    REQUIRE(again);
    CHECK(again->map.point(north) == up);
    CHECK(again->map.point(south) == down);
    // A rotation by no angle, or by half a turn about x, is exact.
    for (Vertex v = 0; v < e.topology.vertex_count(); ++v) {
      const Vector3 x = placed->map.point(v), y = again->map.point(v);
      REQUIRE((y - (turned ? Vector3(x.x(), -x.y(), -x.z()) : x)).norm() < 1e-15);
    }
  }
}

TEST_CASE("place_poles: a pole that is nearer to -z than squares can tell becomes +z") {
  const Embedded e(tube(12, 8));
  const auto placed = place_poles_on_axis(e.topology, e.source, e.map, {0, 0, 1});
  REQUIRE(placed);
  SphereMap map = placed->map;
  map.points.row(placed->south) << 1e-170, 0, -1;
  const auto again =
      place_poles(e.topology, e.source, map, placed->south, placed->north, {.sweeps = 0});
  REQUIRE(again);
  CHECK(again->map.point(placed->south) == up);
  CHECK(again->map.points.allFinite());
}

TEST_CASE("nearest_vertices: as a search through all finds them, ties by index") {
  const SphereMap map{icosphere(3).positions};
  const Vector3 direction(0.3, -0.2, 0.5);
  std::vector<std::pair<double, Vertex>> all;
  for (Vertex v = 0; v < map.points.rows(); ++v) {
    all.push_back({(map.point(v) - direction.normalized()).squaredNorm(), v});
  }
  std::ranges::sort(all);
  const std::vector<Vertex> found = nearest_vertices(map, direction, 20);
  REQUIRE(found.size() == 20);
  for (size_t i = 0; i < found.size(); ++i) CHECK(found[i] == all[i].second);
  CHECK(nearest_vertices({icosahedron().positions}, direction, 99).size() == 12);
}

TEST_CASE("place_poles_on_axis: needles and tubes have poles too") {
  for (const TriangleMesh& mesh : {uv_sphere(600, 10), tube(200, 6)}) {
    const Embedded e(mesh);
    for (const Vector3& axis : {Vector3(0, 0, 1), Vector3(1, 0.1, 0.2)}) {
      const auto placed = place_poles_on_axis(e.topology, e.source, e.map, axis);
      REQUIRE(placed);
      CHECK(certify(e.topology, placed->map).bijective());
    }
  }
}

TEST_CASE("place_poles_on_axis: all but the surroundings of the south pole is only rotated") {
  const Embedded e(icosphere(4));
  const auto placed = place_poles_on_axis(e.topology, e.source, e.map, Vector3(1, 2, 3));
  REQUIRE(placed);
  const Eigen::Matrix3d rotation = rotation_between(e.map.point(placed->north), up);
  long moved = 0;
  for (Vertex v = 0; v < e.topology.vertex_count(); ++v) {
    moved += (placed->map.point(v) - rotation * e.map.point(v)).norm() > 1e-12;
  }
  CHECK(moved > 0);
  CHECK(moved <= 37);  // three rings of valence six
  CHECK(placed->energy_after < 1.0002 * placed->energy_before);
}

TEST_CASE("place_poles_on_axis: no poles where every two vertices are neighbours") {
  const Embedded e(tetrahedron());
  CHECK_FALSE(place_poles_on_axis(e.topology, e.source, e.map, up));
}

TEST_CASE("place_poles: moves any two vertices that share no edge to ±z, certified") {
  const Embedded e(icosphere(3));
  for (const auto& [north, south] : {std::pair{0, 5}, {7, 301}, {640, 12}}) {
    const auto placed = place_poles(e.topology, e.source, e.map, north, south);
    REQUIRE(placed);
    CHECK(placed->map.point(north) == up);
    CHECK(placed->map.point(south) == down);
    CHECK(certify(e.topology, placed->map).bijective());
  }
}

TEST_CASE(
    "embed_progressively: poles held in the hierarchy are exact and cost less than moved ones") {
  const Embedded e(icosphere(4));
  const Vertex north = 100, south = 2000;
  const auto held = embed_progressively(e.mesh, e.topology, {.pins = {{north, up}, {south, down}}});
  REQUIRE(held.map);
  CHECK(all_exact(held.report.pin_residuals));
  CHECK(held.map->point(north) == up);
  CHECK(held.map->point(south) == down);
  CHECK(certify(e.topology, *held.map).bijective());
  const auto moved = place_poles(e.topology, e.source, e.map, north, south);
  REQUIRE(moved);
  CHECK(distortion_energy(e.topology, e.source, *held.map, {}) < moved->energy_after);
}

TEST_CASE("turned_to_meridian: θ is exactly 0, poles keep their bits, distances stay") {
  const Embedded e(icosphere(3));
  const auto placed = place_poles_on_axis(e.topology, e.source, e.map, Vector3(3, 1, 1));
  REQUIRE(placed);
  for (const Vertex v : {1, 17, 200, 641}) {
    if (v == placed->north || v == placed->south) continue;
    const SphereMap turned = turned_to_meridian(placed->map, v);
    CHECK(to_spherical(turned.point(v)).theta == 0);
    CHECK(turned.point(placed->north) == up);
    CHECK(turned.point(placed->south) == down);
    CHECK((turned.point(3) - turned.point(v)).norm() ==
          Approx((placed->map.point(3) - placed->map.point(v)).norm()).margin(1e-14));
    CHECK(certify(e.topology, turned).bijective());
  }
}

TEST_CASE("pole placement: the same bits for any number of threads") {
  const Embedded e(icosphere(5));
  const auto one = place_poles_on_axis(e.topology, e.source, e.map, up, {.threads = 1});
  const auto three = place_poles_on_axis(e.topology, e.source, e.map, up, {.threads = 3});
  REQUIRE((one && three));
  CHECK(one->map.points == three->map.points);
  const SphereMap a = turned_to_meridian(one->map, 9, 1), b = turned_to_meridian(one->map, 9, 3);
  CHECK(a.points == b.points);
}

TEST_CASE("parameterize: automatic poles and a meridian, all exact and certified") {
  const TriangleMesh mesh = random_sphere_mesh(500, 3);
  const Parameterization result = parameterize(mesh);
  REQUIRE(result.certificate.bijective());
  REQUIRE(result.poles);
  CHECK(result.map.point(result.poles->north) == up);
  CHECK(result.map.point(result.poles->south) == down);
  REQUIRE(result.meridian);
  CHECK(to_spherical(result.map.point(*result.meridian)).theta == 0);
  CHECK(certify(Topology(mesh), result.map).bijective());
}

TEST_CASE("parameterize: no poles when none are wanted") {
  const Parameterization result = parameterize(icosphere(3), {.automatic_poles = false});
  CHECK(result.certificate.bijective());
  CHECK_FALSE(result.poles);
  CHECK_FALSE(result.meridian);
}

TEST_CASE("parameterize: given poles and meridian are met, their cost is told") {
  const TriangleMesh mesh = tube(20, 9);
  const Vertex north = 0, south = 90, meridian = 40;
  const Parameterization result =
      parameterize(mesh, {.poles = Poles{north, south}, .meridian = meridian});
  REQUIRE(result.certificate.bijective());
  REQUIRE(result.poles);
  CHECK(result.poles->north == north);
  CHECK(result.map.point(north) == up);
  CHECK(result.map.point(south) == down);
  CHECK(result.pole_cost > 0.001);  // the middle of the tube is far from opposite to its end
  CHECK(result.meridian == meridian);
  CHECK(to_spherical(result.map.point(meridian)).theta == 0);
}

TEST_CASE("parameterize: poles two edges apart are met or refused, never half met") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  for (const Vertex north : {3, 300}) {
    const Halfedge across = topology.twin(Topology::next(topology.outgoing(north)));
    const Vertex south = topology.apex(across);
    REQUIRE(topology.find_halfedge(north, south) < 0);
    const Parameterization result = parameterize(mesh, {.poles = Poles{north, south}});
    CHECK(result.certificate.bijective());
    if (result.poles) {
      CHECK(result.map.point(north) == up);
      CHECK(result.map.point(south) == down);
    } else {
      CHECK(mentions(result.warnings, "could not be moved"));
    }
  }
}

TEST_CASE("parameterize: poles that share an edge are refused by name") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const Vertex north = 5, south = topology.target(topology.outgoing(5));
  const Parameterization result = parameterize(mesh, {.poles = Poles{north, south}});
  CHECK(result.certificate.bijective());
  CHECK_FALSE(result.poles);
  CHECK(mentions(result.warnings, "share an edge"));
}

TEST_CASE("parameterize: a pole is no meridian, and no vertex is out of range") {
  const TriangleMesh mesh = icosphere(2);
  const Parameterization result = parameterize(mesh, {.poles = Poles{0, 77}, .meridian = 0});
  CHECK(result.poles);
  CHECK_FALSE(result.meridian);
  CHECK(mentions(result.warnings, "longitude"));
  CHECK_THROWS(parameterize(mesh, {.meridian = 162}));
  CHECK_THROWS(parameterize(mesh, {.pins = {{162, {0, 1}}}}));
  CHECK_THROWS(parameterize(mesh, {.pins = {{1, {0, 1}}, {1, {2, 1}}}}));
}
