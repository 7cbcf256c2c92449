#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "elementary.h"
#include "embedding/constructions/progressive.h"
#include "embedding/energy/map_image.h"
#include "embedding/twists/layer_slides.h"
#include "embedding/twists/twists.h"
#include "sphparam/sphere/certificate.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

SphereMap embedded(const TriangleMesh& mesh) {
  const Topology topology(mesh);
  const ProgressiveEmbedding embedding = embed_progressively(mesh, topology);
  REQUIRE(embedding.map);
  CHECK(certify(topology, *embedding.map).bijective());
  return *embedding.map;
}

double energy_of(const TriangleMesh& mesh, const SphereMap& map) {
  return distortion_energy(Topology(mesh), measure_source(mesh), map, {});
}

TriangleMesh thin_tube(int rings, int around, double stretch) {
  TriangleMesh mesh = tube(rings, around);
  mesh.positions.col(2) *= stretch;
  return mesh;
}

/// A tube on the sphere as its rings lie on circles of latitude, each so far round.
struct Latitudes {
  TriangleMesh mesh;
  SphereMap map;
};

Latitudes on_latitudes(int rings, int around, int twisted_from, double twist) {
  Latitudes made{tube(rings, around), {}};
  const VectorX z = made.mesh.positions.col(2);
  made.map.points.resize(z.size(), 3);
  for (Eigen::Index v = 0; v < z.size(); ++v) {
    const double share = (z[v] - z.minCoeff()) / (z.maxCoeff() - z.minCoeff());
    const Vector3 x = made.mesh.position(static_cast<Vertex>(v));
    const double phi = std::numbers::pi * (1 - share);
    const double theta =
        elementary::atan2(x.y(), x.x()) + (share * rings > twisted_from ? twist : 0);
    const double sine = elementary::sin(phi);
    made.map.points.row(v) << sine * elementary::cos(theta), sine * elementary::sin(theta),
        elementary::cos(phi);
  }
  return made;
}

/// Of rings: by how much of a place every other vertex is farther on, and every third lower.
struct Polygon {
  double lean = 0.1, bump = 0.4;
};

/// A tube on the sphere as its rings lie on polygons that cannot be turned, each so many vertices
/// on from its place.
template <class TwistOf>
SphereMap on_polygons(int rings, int around, const Polygon& polygon, const TwistOf& twist_of) {
  SphereMap map{Points(rings * around + 2, 3)};
  map.points.row(0) << 0, 0, 1;
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < around; ++i) {
      const int place = (i + around * ring + twist_of(ring)) % around;
      const double theta = 2 * std::numbers::pi / around * (place + polygon.lean * (place % 2));
      const double phi = std::numbers::pi / (rings + 1) * (ring + 1 + polygon.bump * (place % 3));
      const double sine = elementary::sin(phi);
      map.points.row(1 + ring * around + i) << sine * elementary::cos(theta),
          sine * elementary::sin(theta), elementary::cos(phi);
    }
  }
  map.points.row(map.points.rows() - 1) << 0, 0, -1;
  return map;
}

/// The same, each ring so many vertices on from the one before.
SphereMap on_polygons(int rings, int around, int twist) {
  return on_polygons(rings, around, {}, [&](int ring) { return twist * ring; });
}

}  // namespace

TEST_CASE("twists: a limb that is turned by a vertex between two rings is turned back") {
  for (const int around : {4, 5, 6}) {
    const double twist = 2 * std::numbers::pi / around;
    const Latitudes plain = on_latitudes(12, around, 12, 0);
    const Latitudes twisted = on_latitudes(12, around, 6, twist);
    const Topology topology(plain.mesh);
    REQUIRE(certify(topology, twisted.map).bijective());
    std::vector<ImagePoint> image = image_of(twisted.map);
    CHECK(untwist(topology, measure_source(plain.mesh), {}, image) == 1);
    CHECK(energy_of(plain.mesh, map_of(image)) ==
          Approx(energy_of(plain.mesh, plain.map)).epsilon(1e-9));
    CHECK(certify(topology, map_of(image)).bijective());

    std::vector<ImagePoint> straight = image_of(plain.map);
    CHECK(untwist(topology, measure_source(plain.mesh), {}, straight) == 0);
    CHECK(map_of(straight).points == plain.map.points);
  }
}

TEST_CASE("twists: a limb that is turned by a vertex between any two rings slides back") {
  for (const int around : {3, 5, 8, 12}) {
    const int rings = 2 * around + 1;
    const TriangleMesh mesh = tube(rings, around);
    const Topology topology(mesh);
    const SphereMap plain = on_polygons(rings, around, 0);
    const SphereMap twisted = on_polygons(rings, around, -1);
    REQUIRE(certify(topology, plain).bijective());
    REQUIRE(certify(topology, twisted).bijective());
    REQUIRE(energy_of(mesh, twisted) > 1.02 * energy_of(mesh, plain));
    std::vector<ImagePoint> image = image_of(twisted);
    CHECK(untwist(topology, measure_source(mesh), {}, image) == rings - 1);
    CHECK(map_of(image).points == plain.points);
    CHECK(untwist(topology, measure_source(mesh), {}, image) == 0);
  }
}

TEST_CASE("twists: layers that would fit those beside them, but not their places, are turned") {
  // A piece of a tube is turned by a vertex. Its places are wide and narrow in turn, as its edges
  // are: where it slides by one they are not.
  constexpr int around = 12, first = 3, last = 9, rings = 18;
  const auto is_in_piece = [](int ring) { return ring >= first && ring < last; };
  const SphereMap map = on_polygons(rings, around, {.lean = 0.5, .bump = 0},
                                    [&](int ring) { return is_in_piece(ring) ? -1 : 0; });
  TriangleMesh mesh = tube(rings, around);
  mesh.positions = map.points;
  const Eigen::AngleAxisd back(2 * std::numbers::pi / around, Vector3::UnitZ());
  for (Vertex v = 1 + first * around; v < 1 + last * around; ++v)
    mesh.positions.row(v) = back * map.point(v);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  REQUIRE(certify(topology, map).bijective());

  std::vector<ImagePoint> image = image_of(map);
  CHECK(slide_layers(topology, source, {}, LimbSearch(topology).next(), image) == 0);
  CHECK(map_of(image).points == map.points);
  CHECK(untwist(topology, source, {}, image) == 2);
  CHECK(energy_of(mesh, map_of(image)) < 0.8 * energy_of(mesh, map));
  CHECK(certify(topology, map_of(image)).bijective());
}

TEST_CASE("twists: a body without limbs keeps its bits, and a hub costs no square of its valence") {
  for (const TriangleMesh& mesh :
       {icosphere(3), uv_sphere(20'000, 2), random_sphere_mesh(500, 3)}) {
    const SphereMap map = embedded(mesh);
    std::vector<ImagePoint> image = image_of(map);
    CHECK(untwist(Topology(mesh), measure_source(mesh), {}, image) == 0);
    CHECK(map_of(image).points == map.points);
  }
}

TEST_CASE("twists: thin limbs end alike in any order of vertices") {
  for (const TriangleMesh& mesh :
       {thin_tube(30, 4, 1.5), thin_tube(50, 5, 1), thin_tube(100, 9, 4)}) {
    std::vector<double> energies;
    for (unsigned order = 1; order <= 8; ++order) {
      const TriangleMesh other = relabelled(mesh, order);
      energies.push_back(energy_of(other, embedded(other)));
    }
    const auto [least, greatest] = std::ranges::minmax(energies);
    CHECK(greatest < 1.002 * least);
  }
}

TEST_CASE("twists: no turn winds a limb about its middle once more") {
  embedded(relabelled(dumbbell(100, 0.05, 6), 1));  // where all triangles would stay positive
}
