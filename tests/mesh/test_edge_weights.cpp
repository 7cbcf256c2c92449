#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sphparam/mesh/edge_weights.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Detail::Approx;

namespace {

constexpr WeightKind all_kinds[] = {WeightKind::Cotangent, WeightKind::MeanValue,
                                    WeightKind::SymmetricMeanValue};

TriangleMesh lumpy_sphere() {
  TriangleMesh mesh = icosphere(3);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.position(v);
    mesh.positions.row(v) = p * (1 + 0.3 * std::sin(3 * p.x() + 5 * p.y()) * std::cos(4 * p.z()));
  }
  return mesh;
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

TEST_CASE("edge_weights: linear functions are reproduced on a planar patch") {
  TriangleMesh mesh = icosphere(3);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    mesh.positions(v, 0) += 0.2 * mesh.positions(v, 1);  // sheared, so that no triangle is special
  }
  const Points round = mesh.positions;
  mesh.positions.col(2).setZero();
  const Topology topology(mesh);
  for (const WeightKind kind : {WeightKind::Cotangent, WeightKind::MeanValue}) {
    const std::vector<double> w = EdgeWeights(mesh, topology, kind).with(topology);
    int checked = 0;
    for (Vertex i = 0; i < mesh.vertex_count(); ++i) {
      bool in_patch = true;
      Vector3 sum = Vector3::Zero();
      double size = 0;
      topology.for_each_outgoing(i, [&](Halfedge h) {
        const Vertex j = topology.target(h);
        in_patch = in_patch && round(j, 2) > 0.1;
        sum += w[static_cast<size_t>(h)] * (mesh.position(j) - mesh.position(i));
        size += std::abs(w[static_cast<size_t>(h)]);
      });
      if (!in_patch) continue;
      ++checked;
      CHECK(sum.norm() < 1e-12 * size);
    }
    CHECK(checked > 100);
  }
}

TEST_CASE(
    "edge_weights: on equilateral triangles cotangents are cot 60°, mean values 2 tan 30°/r") {
  const TriangleMesh mesh = icosahedron();
  const Topology topology(mesh);
  const double r = (mesh.position(topology.origin(0)) - mesh.position(topology.target(0))).norm();
  for (const double w : EdgeWeights(mesh, topology, WeightKind::Cotangent).with(topology)) {
    CHECK(w == Approx(1 / std::sqrt(3.0)));
  }
  for (const double w : EdgeWeights(mesh, topology, WeightKind::MeanValue).with(topology)) {
    CHECK(w == Approx(2 / std::sqrt(3.0) / r));
  }
}

TEST_CASE("edge_weights: symmetric kinds are symmetric, one is the mean of the mean values") {
  const TriangleMesh mesh = lumpy_sphere();
  const Topology topology(mesh);
  std::vector<double> kappa(static_cast<size_t>(topology.face_count()));
  for (size_t f = 0; f < kappa.size(); ++f) kappa[f] = 1 + static_cast<double>(f % 7);
  const auto cotangent = EdgeWeights(mesh, topology, WeightKind::Cotangent).with(topology, kappa);
  const auto mean_value = EdgeWeights(mesh, topology, WeightKind::MeanValue).with(topology, kappa);
  const auto symmetric =
      EdgeWeights(mesh, topology, WeightKind::SymmetricMeanValue).with(topology, kappa);
  double asymmetry = 0;
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const size_t i = static_cast<size_t>(h), j = static_cast<size_t>(topology.twin(h));
    CHECK(cotangent[i] == Approx(cotangent[j]).epsilon(1e-14));
    CHECK(symmetric[i] == Approx(symmetric[j]).epsilon(1e-14));
    CHECK(symmetric[i] == Approx(0.5 * (mean_value[i] + mean_value[j])).epsilon(1e-13));
    asymmetry = std::max(asymmetry, std::abs(mean_value[i] / mean_value[j] - 1));
  }
  CHECK(asymmetry > 0.01);
}

TEST_CASE(
    "edge_weights: weights are linear in kappa, and the kappa of a face moves its edges only") {
  const TriangleMesh mesh = lumpy_sphere();
  const Topology topology(mesh);
  const std::vector<double> ones(static_cast<size_t>(topology.face_count()), 1);
  for (const WeightKind kind : all_kinds) {
    const EdgeWeights weights(mesh, topology, kind);
    const std::vector<double> plain = weights.with(topology);
    CHECK(weights.with(topology, ones) == plain);
    std::vector<double> raised = ones;
    raised[17] = 3;
    const std::vector<double> with_raised = weights.with(topology, raised);
    for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
      const bool at_face = Topology::face(h) == 17 || Topology::face(topology.twin(h)) == 17;
      CHECK((with_raised[static_cast<size_t>(h)] != plain[static_cast<size_t>(h)]) == at_face);
    }
  }
}

TEST_CASE("edge_weights: degenerate triangles leave mean values positive and all weights finite") {
  TriangleMesh mesh = lumpy_sphere();
  const Topology topology(mesh);
  // A coincident pair, a vertex in the middle of an opposite edge, a triangle shrunk to a point.
  mesh.positions.row(topology.target(30)) = mesh.positions.row(topology.origin(30));
  mesh.positions.row(topology.apex(600)) =
      0.5 * (mesh.positions.row(topology.origin(600)) + mesh.positions.row(topology.target(600)));
  for (int k = 1; k < 3; ++k) {
    mesh.positions.row(topology.vertex(400, k)) = mesh.positions.row(topology.vertex(400, 0));
  }
  for (const WeightKind kind : all_kinds) {
    const EdgeWeights weights(mesh, topology, kind);
    const std::vector<double> w = weights.with(topology);
    CHECK(all_finite(w));
    if (kind == WeightKind::Cotangent) continue;
    CHECK(*std::min_element(w.begin(), w.end()) > 0);
    CHECK(weights.clamped() > 0);
  }
  CHECK(EdgeWeights(lumpy_sphere(), topology, WeightKind::MeanValue).clamped() == 0);
}

TEST_CASE("edge_weights: the same bytes for 1, 2 and 4 threads") {
  const TriangleMesh mesh = icosphere(5);
  const Topology topology(mesh);
  for (const WeightKind kind : all_kinds) {
    const auto one = EdgeWeights(mesh, topology, kind, 1).with(topology, {}, 1);
    CHECK(one == EdgeWeights(mesh, topology, kind, 2).with(topology, {}, 2));
    CHECK(one == EdgeWeights(mesh, topology, kind, 4).with(topology, {}, 4));
  }
}
