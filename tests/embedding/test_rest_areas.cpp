#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "embedding/energy/rest_areas.h"
#include "embedding/newton/optimise.h"
#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

double total_area(const RestTriangles& source) {
  double area = 0;
  for (const RestTriangle& triangle : source) area += triangle.area;
  return area;
}

/// Twice as much on the northern half as on the southern.
Eigen::VectorXd northern(const TriangleMesh& mesh) {
  return 1.5 + 0.5 * mesh.positions.col(2).array().sign();
}

}  // namespace

TEST_CASE("One density everywhere, of whatever unit, changes no bit") {
  const TriangleMesh mesh = random_sphere_mesh(200, 4);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  for (const double density : {1.0, 0.3, 1e9}) {
    const RestTriangles same =
        with_density(topology, source, Eigen::VectorXd::Constant(mesh.vertex_count(), density));
    for (size_t f = 0; f < source.size(); ++f) {
      CHECK(same[f].area == source[f].area);
      CHECK(same[f].inverse_base == source[f].inverse_base);
      CHECK(same[f].inverse_height == source[f].inverse_height);
      CHECK(same[f].foot == source[f].foot);
    }
  }
}

TEST_CASE("Densities move area between triangles and leave their shapes and the total") {
  const TriangleMesh mesh = icosphere(3);
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  const Eigen::VectorXd density = northern(mesh);
  const RestTriangles weighted = with_density(topology, source, density);
  CHECK(total_area(weighted) == Approx(4 * std::numbers::pi));
  for (size_t f = 0; f < source.size(); ++f) {
    const double mean = (density[mesh.triangles(static_cast<Face>(f), 0)] +
                         density[mesh.triangles(static_cast<Face>(f), 1)] +
                         density[mesh.triangles(static_cast<Face>(f), 2)]) /
                        3;
    CHECK(weighted[f].area / source[f].area ==
          Approx(mean / density.mean()).epsilon(0.01));  // vertices have about equal areas
    CHECK(weighted[f].foot == source[f].foot);
    CHECK(weighted[f].inverse_base / weighted[f].inverse_height ==
          Approx(source[f].inverse_base / source[f].inverse_height));
    CHECK(weighted[f].area * 2 * weighted[f].inverse_base * weighted[f].inverse_height ==
          Approx(1));
  }
}

TEST_CASE("A map made for densities gives dense places more of the sphere, and stays one-to-one") {
  const TriangleMesh mesh = icosphere(4);
  const Topology topology(mesh);
  const RestTriangles source = with_density(topology, measure_source(mesh), northern(mesh));
  const SphereMap map =
      optimise(topology, source, {mesh.positions}, {.energy = {.lambda = 100}}).map;
  CHECK(certify(topology, map).bijective());
  double north = 0;  // solid angle of what was the northern half: was 2π
  for (Face f = 0; f < topology.face_count(); ++f) {
    const Vector3 a = map.point(topology.vertex(f, 0)), b = map.point(topology.vertex(f, 1)),
                  c = map.point(topology.vertex(f, 2));
    const bool is_northern =
        (mesh.position(topology.vertex(f, 0)) + mesh.position(topology.vertex(f, 1)) +
         mesh.position(topology.vertex(f, 2)))
            .z() > 0;
    if (is_northern) north += 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  CHECK(north / (4 * std::numbers::pi) == Approx(2.0 / 3).epsilon(0.05));
}

TEST_CASE("What is no density is refused") {
  const TriangleMesh mesh = icosahedron();
  const Topology topology(mesh);
  const RestTriangles source = measure_source(mesh);
  Eigen::VectorXd density = Eigen::VectorXd::Ones(12);
  CHECK_THROWS_AS(with_density(topology, source, Eigen::VectorXd::Ones(11)), std::invalid_argument);
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    density[3] = wrong;
    CHECK_THROWS_AS(with_density(topology, source, density), std::invalid_argument);
  }
}
