#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "elastic_network.h"
#include "embedding/conjugate_gradients.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE(
    "conjugate gradients: solve until nothing is gained, in about as many iterations at any size") {
  int before = 0;
  for (const int level : {3, 4, 5}) {
    const Network network(icosphere(level), 1e-3);  // turns 1e6 times too large would drown floats
    Multigrid multigrid = network.multigrid();
    const Unknowns b = random_vector(network.size(), 3);
    const LinearSolution s =
        solve_by_conjugate_gradients(network.matrix, multigrid, b, 1e-9, 200, 1);
    const Eigen::VectorXd rhs =
        Eigen::Map<const Eigen::VectorXf>(b.data(), static_cast<Eigen::Index>(b.size()))
            .cast<double>();
    CHECK((network.times(s.x) - rhs).norm() < 1e-3 * rhs.norm());
    CHECK(s.gain == Approx(dot(b, s.x)).epsilon(1e-3));
    CHECK(s.iterations < 60);
    if (before > 0) CHECK(s.iterations < 2 * before);
    before = s.iterations;
  }
}
