#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "remesh/sample_density.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/remesh.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

/// An egg: its tip at +z bends three times as much as anything else.
TriangleMesh egg() {
  TriangleMesh mesh = icosphere(5);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions(v, 2) > 0) mesh.positions(v, 2) *= 3;
  }
  return mesh;
}

double remeshed_rms(const TriangleMesh& mesh, const SphereMap& map, const SphereGrid& grid) {
  const Remeshed result = remesh(mapped(mesh, map), grid, {.transfer = {"none"}});
  return measure_distance(mesh, result.mesh(), {.samples = 20'000}).rms();
}

}  // namespace

TEST_CASE("A sphere has the same density everywhere") {
  const TriangleMesh mesh = icosphere(4);
  const Eigen::VectorXd density = sample_density(mesh, Topology(mesh), 642);
  CHECK(density.minCoeff() > 0.9);  // vertices of valence 5 have smaller stars
  CHECK(density.maxCoeff() < 1.1);
}

TEST_CASE("Density does not depend on the mesh's size, which may be extreme") {
  TriangleMesh mesh = egg();
  const Topology topology(mesh);
  const Eigen::VectorXd density = sample_density(mesh, topology, 642);
  for (const double size : {1e-290, 1e-3, 1e290}) {
    TriangleMesh other = mesh;
    other.positions *= size;
    CHECK((sample_density(other, topology, 642) - density).cwiseAbs().maxCoeff() < 1e-6);
  }
}

TEST_CASE("Where the surface bends density is greater, by a bounded ratio") {
  const TriangleMesh mesh = egg();
  const Eigen::VectorXd density = sample_density(mesh, Topology(mesh), 642);
  Eigen::Index tip = 0, flank = 0;
  mesh.positions.col(2).maxCoeff(&tip);
  (mesh.positions.rowwise() - Eigen::RowVector3d(1, 0, 1)).rowwise().norm().minCoeff(&flank);
  CHECK(density[tip] > 2 * density[flank]);
  for (const TriangleMesh& hard : {random_sphere_mesh(300, 5), tube(200, 5), tetrahedron()}) {
    const Eigen::VectorXd of_hard = sample_density(hard, Topology(hard), 162);
    CHECK(of_hard.minCoeff() >= 0.4);
    CHECK(of_hard.allFinite());
  }
}

TEST_CASE("A surface without area has density 1") {
  TriangleMesh mesh = icosahedron();
  mesh.positions.setZero();
  CHECK(sample_density(mesh, Topology(mesh), 42) == Eigen::VectorXd::Ones(12));
}

TEST_CASE("An adapted map is one-to-one, and a grid on it is nearer to its source") {
  const TriangleMesh mesh = egg();
  const Topology topology(mesh);
  const SphereMap map = parameterize(mesh, {.energy = {.lambda = remeshing_lambda}}).map;
  const SphereGrid grid = make_grid(parse_grid("ico:3"));
  const Adaptation adapted = adapt_map(mapped(mesh, map), grid.directions.rows());
  CHECK(certify(topology, adapted.mapped.map()).bijective());
  CHECK(adapted.steps > 0);
  CHECK(adapted.least_density < 1);
  CHECK(adapted.greatest_density > 1);
  CHECK(remeshed_rms(mesh, adapted.mapped.map(), grid) < 0.9 * remeshed_rms(mesh, map, grid));
}

TEST_CASE("The adapted map has the same bytes for any number of threads") {
  const TriangleMesh mesh = egg();
  const MappedMesh source = mapped(mesh, parameterize(mesh).map);
  const SphereMap one = adapt_map(source, 642, {.threads = 1}).mapped.map();
  CHECK(adapt_map(source, 642, {.threads = 3}).mapped.map().points == one.points);
}

TEST_CASE("What a map cannot be adapted to is refused before any work") {
  const TriangleMesh mesh = icosphere(1);
  const MappedMesh source = mapped(mesh, {mesh.positions});
  const Progress never = [](std::string_view, double) { return false; };
  for (const std::int64_t samples : {0, -1})
    CHECK_THROWS_AS(adapt_map(source, samples, {.progress = never}), std::invalid_argument);
  for (const double lambda : {0.0, -1.0, 2e6, std::nan("")}) {
    CHECK_THROWS_AS(adapt_map(source, 42, {.lambda = lambda, .progress = never}),
                    std::invalid_argument);
  }
}
