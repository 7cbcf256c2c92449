#include <catch2/catch.hpp>

#include "sphparam/baselines/tangential.h"
#include "sphparam/sphere/certificate.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("tangential: a regular sphere rests") {
  const TriangleMesh mesh = icosahedron();
  for (const auto kind :
       {TangentialOptions::Operator::Uniform, TangentialOptions::Operator::MeanValue}) {
    const BaselineResult result = map_tangential(mesh, Topology(mesh), {.laplacian = kind});
    REQUIRE(result.map);
    CHECK(result.end == BaselineEnd::Converged);
    CHECK(result.iterations == 1);
    CHECK((result.map->points - mesh.positions).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("tangential: folds of the central projection are smoothed away") {
  TriangleMesh mesh = icosphere(3);  // bent until its centre is outside
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.position(v);
    mesh.positions.row(v) << p.x(), 0.3 * p.y() + 0.8 * p.x() * p.x(), 0.4 * p.z();
  }
  const Topology topology(mesh);
  const auto uniform = TangentialOptions::Operator::Uniform;
  const BaselineResult start =
      map_tangential(mesh, topology, {.laplacian = uniform, .max_sweeps = 0});
  const BaselineResult result = map_tangential(mesh, topology, {.laplacian = uniform});
  CHECK(start.end == BaselineEnd::IterationLimit);
  CHECK(certify(topology, *start.map).fold_count() > 0);
  CHECK(result.end == BaselineEnd::Converged);
  CHECK(certify(topology, *result.map).fold_count() == 0);
}

TEST_CASE("tangential: the limit of sweeps is kept and told") {
  const TriangleMesh mesh = random_sphere_mesh(400, 3);
  const BaselineResult result =
      map_tangential(mesh, Topology(mesh), {.max_sweeps = 70, .sweeps_per_anchors = 20});
  CHECK(result.iterations == 70);
  CHECK(result.end == BaselineEnd::IterationLimit);
  CHECK(result.statement.find("folded after 70 sweeps and 4 sets of anchors") != std::string::npos);
}

TEST_CASE("tangential: a map that begins to slip is kept as it was before") {
  TriangleMesh mesh = icosphere(3);  // seen whole from its centre, yet mean values slip
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.position(v);
    mesh.positions.row(v) << p.x(), 0.3 * p.y() + 0.5 * p.x() * p.x(), 0.3 * p.z();
  }
  const Topology topology(mesh);
  const BaselineResult result = map_tangential(mesh, topology);
  CHECK(result.end == BaselineEnd::Converged);
  CHECK(result.statement.find("more sweeps fold some") != std::string::npos);
  CHECK(certify(topology, *result.map).bijective());
}
