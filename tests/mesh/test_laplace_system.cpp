#include <catch2/catch.hpp>
#include <random>
#include <type_traits>

#include "mesh/laplace_system.h"
#include "sphparam/errors.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Detail::Approx;

namespace {

// A system keeps a reference to its topology.
static_assert(!std::is_constructible_v<LaplaceSystem, Topology, std::vector<VertexRole>, bool>);
static_assert(std::is_constructible_v<LaplaceSystem, Topology&, std::vector<VertexRole>, bool>);

/// Random positive weights; equal for twins where `symmetric`.
std::vector<double> random_weights(const Topology& topology, bool symmetric, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.1, 10);
  std::vector<double> weights(static_cast<size_t>(topology.halfedge_count()));
  for (double& w : weights) w = uniform(random);
  if (!symmetric) return weights;
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    weights[static_cast<size_t>(topology.twin(h))] = weights[static_cast<size_t>(h)];
  }
  return weights;
}

/// Vertex 0 removed, its neighbours fixed at random values and one far vertex as well.
struct Problem {
  Topology topology;
  std::vector<VertexRole> roles;
  Eigen::MatrixXd values;
  std::vector<Jump> jumps;
};

Problem random_problem(const TriangleMesh& mesh) {
  Problem problem{Topology(mesh), {}, Eigen::MatrixXd::Zero(mesh.vertex_count(), 2), {}};
  const Topology& topology = problem.topology;
  problem.roles.assign(static_cast<size_t>(topology.vertex_count()), VertexRole::Free);
  problem.roles[0] = VertexRole::Removed;
  topology.for_each_outgoing(0, [&](Halfedge h) {
    problem.roles[static_cast<size_t>(topology.target(h))] = VertexRole::Fixed;
  });
  problem.roles.back() = VertexRole::Fixed;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    if (problem.roles[static_cast<size_t>(v)] != VertexRole::Fixed) continue;
    problem.values(v, 0) = uniform(random);
    problem.values(v, 1) = uniform(random);
  }
  for (Halfedge h = 0; h < topology.halfedge_count(); h += 11) {
    problem.jumps.push_back({h, 1.5});
    problem.jumps.push_back({topology.twin(h), -1.5});
  }
  return problem;
}

/// Σ_j w_ij (U_j + jump_ij − U_i), the largest over all free vertices.
double largest_residual(const Problem& problem, const std::vector<double>& weights,
                        const Eigen::VectorXd& u, const std::vector<Jump>& jumps) {
  const Topology& topology = problem.topology;
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(topology.vertex_count());
  const auto removed = [&](Vertex v) {
    return problem.roles[static_cast<size_t>(v)] == VertexRole::Removed;
  };
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const Vertex i = topology.origin(h), j = topology.target(h);
    if (!removed(j)) residual[i] += weights[static_cast<size_t>(h)] * (u[j] - u[i]);
  }
  for (const Jump& jump : jumps) {
    if (removed(topology.target(jump.halfedge))) continue;
    residual[topology.origin(jump.halfedge)] +=
        weights[static_cast<size_t>(jump.halfedge)] * jump.value;
  }
  double largest = 0;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    if (problem.roles[static_cast<size_t>(v)] != VertexRole::Free) continue;
    largest = std::max(largest, std::abs(residual[v]));
  }
  return largest;
}

}  // namespace

TEST_CASE("laplace_system: the equation holds at every free vertex, jumps included") {
  const Problem problem = random_problem(random_sphere_mesh(400, 3));
  for (const bool symmetric : {true, false}) {
    const std::vector<double> weights = random_weights(problem.topology, symmetric, 5);
    LaplaceSystem system(problem.topology, problem.roles, symmetric);
    system.factorise(weights);
    const Eigen::MatrixXd u = system.solve(problem.values, {problem.jumps, {}});
    CHECK(largest_residual(problem, weights, u.col(0), problem.jumps) < 1e-10);
    CHECK(largest_residual(problem, weights, u.col(1), {}) < 1e-10);
  }
}

TEST_CASE("laplace_system: fixed vertices keep their values, free ones stay within them") {
  const Problem problem = random_problem(icosphere(3));
  for (const bool symmetric : {true, false}) {
    LaplaceSystem system(problem.topology, problem.roles, symmetric);
    system.factorise(random_weights(problem.topology, symmetric, 6));
    const Eigen::MatrixXd u = system.solve(problem.values);
    for (Vertex v = 0; v < problem.topology.vertex_count(); ++v) {
      const bool fixed = problem.roles[static_cast<size_t>(v)] == VertexRole::Fixed;
      if (fixed) CHECK(u.row(v) == problem.values.row(v));
      CHECK(u(v, 0) <= problem.values.col(0).maxCoeff());
      CHECK(u(v, 0) >= problem.values.col(0).minCoeff());
    }
  }
}

TEST_CASE("laplace_system: weights at a removed vertex do not matter") {
  const Problem problem = random_problem(icosphere(2));
  std::vector<double> weights = random_weights(problem.topology, true, 8);
  LaplaceSystem system(problem.topology, problem.roles, true);
  system.factorise(weights);
  const Eigen::MatrixXd before = system.solve(problem.values, {problem.jumps, problem.jumps});
  problem.topology.for_each_outgoing(0, [&](Halfedge h) {
    weights[static_cast<size_t>(h)] = 1e6;
    weights[static_cast<size_t>(problem.topology.twin(h))] = 1e6;
  });
  system.factorise(weights);
  CHECK(system.solve(problem.values, {problem.jumps, problem.jumps}) == before);
}

TEST_CASE("laplace_system: factorising again is the same as starting afresh") {
  const Problem problem = random_problem(icosphere(3));
  for (const bool symmetric : {true, false}) {
    const std::vector<double> weights = random_weights(problem.topology, symmetric, 9);
    LaplaceSystem used(problem.topology, problem.roles, symmetric);
    used.factorise(random_weights(problem.topology, symmetric, 10));
    used.factorise(weights);
    LaplaceSystem fresh(problem.topology, problem.roles, symmetric);
    fresh.factorise(weights);
    CHECK(used.solve(problem.values) == fresh.solve(problem.values));
  }
}

TEST_CASE("laplace_system: a singular system is an error that names it") {
  const Problem problem = random_problem(octahedron());
  for (const bool symmetric : {true, false}) {
    LaplaceSystem system(problem.topology, std::vector<VertexRole>(6, VertexRole::Free), symmetric);
    const std::vector<double> zeros(static_cast<size_t>(problem.topology.halfedge_count()), 0);
    CHECK_THROWS_AS(system.factorise(zeros), SolveError);
    CHECK_THROWS_WITH(system.factorise(zeros), Catch::Contains("Laplace system of 6 unknowns"));
  }
}

TEST_CASE("laplace_system: without unknowns the values come back") {
  const Topology topology(octahedron());
  LaplaceSystem system(topology, std::vector<VertexRole>(6, VertexRole::Fixed), true);
  system.factorise(std::vector<double>(static_cast<size_t>(topology.halfedge_count()), 1));
  const Eigen::MatrixXd values = Eigen::MatrixXd::Random(6, 3);
  CHECK(system.solve(values) == values);
}

TEST_CASE("laplace_system: the same bytes for 1, 2 and 4 threads") {
  const Problem problem = random_problem(icosphere(5));
  const std::vector<double> weights = random_weights(problem.topology, true, 11);
  LaplaceSystem system(problem.topology, problem.roles, true);
  system.factorise(weights, 1);
  const Eigen::MatrixXd one = system.solve(problem.values, {problem.jumps, {}}, 1);
  for (const int threads : {2, 4}) {
    system.factorise(weights, threads);
    CHECK(system.solve(problem.values, {problem.jumps, {}}, threads) == one);
  }
}
