#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "elastic_network.h"
#include "embedding/newton/conjugate_gradients.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE(
    "conjugate gradients: solve until nothing is gained, in about as many iterations at any size") {
  int before = 0;
  for (const int level : {3, 4, 5}) {
    const Network network(icosphere(level), 1e-3);
    Multigrid multigrid = network.multigrid();
    const Unknowns b = random_vector(network.size(), 3);
    const LinearSolution s =
        solve_by_conjugate_gradients(network.matrix, multigrid, b, 1e-9, 200, 1);
    const Eigen::VectorXd rhs =
        Eigen::Map<const Eigen::VectorXd>(b.data(), static_cast<Eigen::Index>(b.size()));
    CHECK((network.times(s.x) - rhs).norm() < 1e-3 * rhs.norm());
    CHECK(s.gain == Approx(dot(b, s.x)).epsilon(1e-3));
    CHECK(s.iterations < 60);
    if (before > 0) CHECK(s.iterations < 2 * before);
    before = s.iterations;
  }
}

TEST_CASE("conjugate gradients: the first iteration that gains less than its share is the last") {
  const Network network(icosphere(3), 1e-3);
  const Unknowns b = random_vector(network.size(), 5);
  const auto solve = [&](double least_share, int most_iterations) {
    Multigrid multigrid = network.multigrid();
    return solve_by_conjugate_gradients(network.matrix, multigrid, b, least_share, most_iterations,
                                        1);
  };
  for (const double share : {0.5, 0.1, 0.02}) {
    int expected = 0;
    double before = 0, gained = 1;
    while (gained > share) {
      const LinearSolution so_far = solve(0, ++expected);
      REQUIRE(so_far.iterations == expected);
      gained = (so_far.gain - before) / so_far.gain;
      before = so_far.gain;
    }
    REQUIRE(expected > 1);
    const LinearSolution solution = solve(share, 60);
    CHECK(solution.iterations == expected);
    CHECK(solution.x == solve(0, expected).x);
    CHECK(solution.gain == before);
  }
  CHECK(solve(0.02, 1).iterations == 1);
  CHECK(solve(0.02, 0).x == Unknowns(network.size(), 0.0));
}

TEST_CASE("conjugate gradients: a direction without curvature ends them, and is not taken") {
  const Network network(icosphere(2), 1e-3);
  BlockMatrix<2> matrix = network.matrix;
  const double sign = GENERATE(0, -1);
  for (Block<2>& block : matrix.off) block = {};
  for (Block<2>& block : matrix.diagonal) {
    block = {{sign, 0, 0, sign}};
  }
  Multigrid multigrid = network.multigrid();
  const LinearSolution solution =
      solve_by_conjugate_gradients(matrix, multigrid, random_vector(network.size(), 7), 0.1, 60, 1);
  CHECK(solution.iterations == 0);
  CHECK(solution.gain == 0);
  CHECK_FALSE(solution.complete);
  CHECK(solution.x == Unknowns(network.size(), 0.0));
}
