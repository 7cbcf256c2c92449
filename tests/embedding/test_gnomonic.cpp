#include <catch2/catch.hpp>
#include <map>
#include <numbers>

#include "embedding/constructions/gnomonic.h"
#include "folded_maps.h"
#include "sphparam/sphere/certificate.h"
#include "support/all_triangulations.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

SphereMap lift_without(const TriangleMesh& mesh, const Topology& topology, Vertex south) {
  return gnomonic_lift(tutte_disk(mesh, topology, south),
                       vertex_areas(topology, measure_source(mesh)));
}

}  // namespace

TEST_CASE(
    "gnomonic_lift: certified for every triangulation up to 10 vertices, whatever is left out") {
  const std::map<int, size_t> types{{4, 1}, {5, 1}, {6, 2}, {7, 5}, {8, 14}, {9, 50}, {10, 233}};
  for (const auto& [vertices, count] : types) {
    const std::vector<Rotations> triangulations = all_triangulations(vertices);
    CHECK(triangulations.size() == count);
    int failures = 0;
    for (size_t i = 0; i < triangulations.size(); ++i) {
      const TriangleMesh mesh = mesh_of(triangulations[i], static_cast<unsigned>(i));
      const Topology topology(mesh);
      for (Vertex south = 0; south < vertices; ++south) {
        failures += !certify(topology, lift_without(mesh, topology, south), 1).bijective();
      }
    }
    CHECK(failures == 0);
  }
}

TEST_CASE("gnomonic_embedding: certified for every triangulation up to 8 vertices") {
  for (int vertices = 4; vertices <= 8; ++vertices) {
    for (const Rotations& rotations : all_triangulations(vertices)) {
      const TriangleMesh mesh = mesh_of(rotations, 1);
      const Topology topology(mesh);
      const GnomonicEmbedding embedding = gnomonic_embedding(mesh, topology, {.threads = 1});
      CHECK(embedding.bijective);
      CHECK(certify(topology, embedding.map, 1).bijective());
    }
  }
}

TEST_CASE("tutte_disk: the link runs counter-clockwise around 0 with gaps below pi") {
  for (const TriangleMesh& mesh : {tetrahedron(), icosphere(2), uv_sphere(3, 4), tube(20, 5)}) {
    const Topology topology(mesh);
    for (Vertex south = 0; south < topology.vertex_count(); south += 3) {
      const OneVertexDisk disk = tutte_disk(mesh, topology, south);
      topology.for_each_outgoing(south, [&](Halfedge h) {
        // The face (south, a, b): from b to a is counter-clockwise.
        const auto a = disk.points.row(topology.target(h));
        const auto b = disk.points.row(topology.apex(h));
        CHECK(a.norm() == Approx(1));
        CHECK(b.x() * a.y() - b.y() * a.x() > 0.49);
      });
      for (Eigen::Index v = 0; v < disk.points.rows(); ++v) {
        CHECK(disk.points.row(v).norm() < 1 + 1e-12);
      }
    }
  }
}

TEST_CASE("gnomonic_lift: a link of 100000 vertices is still strictly convex") {
  const TriangleMesh mesh = uv_sphere(100000, 1);
  const Topology topology(mesh);
  const SphereMap map = lift_without(mesh, topology, 0);
  CHECK(certify(topology, map).bijective());
}

TEST_CASE("stereographic_lift: centres the weights, and maps a round sphere nearly to itself") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const Eigen::VectorXd areas = vertex_areas(topology, source);
  CHECK(areas.sum() == Approx(4 * std::numbers::pi));
  const SphereMap map = stereographic_lift(tutte_disk(mesh, topology, 77), areas);
  CHECK((map.points.transpose() * areas).norm() < 0.011 * areas.sum());
  CHECK(certify(topology, map).bijective());
  const double isometry = distortion_energy(topology, source, {mesh.positions}, {});
  CHECK(distortion_energy(topology, source, map, {}) < 1.05 * isometry);
}

TEST_CASE("middle_vertex: lies half-way along a tube") {
  const int rings = 41, around = 6;
  const TriangleMesh mesh = tube(rings, around);
  const Vector3 middle = mesh.position(middle_vertex(Topology(mesh)));
  const double low = mesh.positions.col(2).minCoeff(), high = mesh.positions.col(2).maxCoeff();
  CHECK(std::abs(middle.z() - (low + high) / 2) <= 2);
}

TEST_CASE("gnomonic_embedding: embeds from nothing, close to what the shape asks for") {
  struct Case {
    TriangleMesh mesh;
    double largest_energy;  // over 4π; 2 is an isometry
  };
  const std::vector<Case> cases{{icosphere(3), 2.02},
                                {uv_sphere(40, 20), 2.1},
                                {octahedron(), 4},
                                {uv_sphere(2000, 2), 1e9},
                                {tube(40, 12), 1e3}};
  for (const Case& c : cases) {
    const Topology topology(c.mesh);
    const GnomonicEmbedding embedding = gnomonic_embedding(c.mesh, topology);
    CHECK(embedding.bijective);
    CHECK(certify(topology, embedding.map).bijective());
    CHECK(embedding.report.relaxation.energy_after < c.largest_energy * 4 * std::numbers::pi);
  }
}

TEST_CASE("gnomonic_embedding: random connectivities with crumpled shapes") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const TriangleMesh mesh = random_sphere_mesh(20 + 10 * static_cast<int>(seed), seed);
    const Topology topology(mesh);
    CHECK(gnomonic_embedding(mesh, topology, {.sweeps = 2}).bijective);
  }
}

TEST_CASE("gnomonic_embedding: leaves out the vertex it is told to") {
  const TriangleMesh mesh = icosphere(2);
  const Topology topology(mesh);
  const GnomonicEmbedding embedding = gnomonic_embedding(mesh, topology, {.south = 33});
  CHECK(embedding.report.south == 33);
  CHECK(embedding.report.attempts == 1);
  CHECK(embedding.bijective);
}

TEST_CASE("gnomonic_embedding: the same bytes for 1, 2 and 4 threads") {
  const TriangleMesh mesh = tube(60, 6);
  const Topology topology(mesh);
  const GnomonicEmbedding one = gnomonic_embedding(mesh, topology, {.threads = 1});
  for (const int threads : {2, 4}) {
    CHECK(gnomonic_embedding(mesh, topology, {.threads = threads}).map.points == one.map.points);
  }
}
