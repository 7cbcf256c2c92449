#include <catch2/catch.hpp>

#include "elastic_network.h"
#include "embedding/multigrid/multigrid.h"
#include "embedding/newton/conjugate_gradients.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("multigrid: a V-cycle is symmetric and positive definite") {
  const Network network(icosphere(4));
  Multigrid multigrid = network.multigrid();
  REQUIRE(multigrid.levels() >= 2);
  const Unknowns a = random_vector(network.size(), 1), b = random_vector(network.size(), 2);
  Unknowns ma(a.size()), mb(b.size()), room(a.size());
  multigrid.apply(a, ma, room);
  multigrid.apply(b, mb, room);
  CHECK(dot(a, mb) == Approx(dot(b, ma)).epsilon(1e-9));
  CHECK(dot(a, ma) > 0);
  CHECK(dot(b, mb) > 0);
}

TEST_CASE("multigrid: turns of the whole sphere are solved on the coarsest level") {
  // Only the foundation resists a turn: without the rotations among the modes this takes hundreds.
  const Network network(icosphere(4));
  Multigrid multigrid = network.multigrid();
  Unknowns turn;
  for (const ImagePoint& p : network.points) {
    const Vector3 velocity = Vector3(0.3, -0.5, 0.8).cross(p.vector());
    const TangentFrame frame = tangent_frame(p.vector());
    turn.push_back(velocity.dot(frame.u));
    turn.push_back(velocity.dot(frame.v));
  }
  const LinearSolution s =
      solve_by_conjugate_gradients(network.matrix, multigrid, turn, 1e-3, 50, 1);
  CHECK(s.iterations <= 5);
  CHECK(dot(s.x, turn) == Approx(1e6 * dot(turn, turn)).epsilon(0.2));
}

TEST_CASE("multigrid: pinned rows do not move, the same bits for any number of threads") {
  Network network(icosphere(5));
  std::vector<char> pinned(network.points.size(), 0);
  pinned[7] = pinned[100] = 1;
  BlockMatrix<2>& a = network.matrix;
  for (int r = 0; r < a.rows(); ++r) {
    const auto row = static_cast<size_t>(r);
    for (int e = a.start[row]; e < a.start[row + 1]; ++e) {
      if (pinned[row] || pinned[static_cast<size_t>(a.column[static_cast<size_t>(e)])]) {
        a.off[static_cast<size_t>(e)] = {};
      }
    }
    if (pinned[row]) a.diagonal[row] = {{1, 0, 0, 1}};
  }
  Unknowns b = random_vector(network.size(), 4);
  for (const size_t v : {7u, 100u}) b[2 * v] = b[2 * v + 1] = 0;
  Unknowns first;
  for (const int threads : {1, 2, 3}) {
    Multigrid multigrid(a, network.order, network.points.data(), network.units.data(), pinned,
                        threads);
    const LinearSolution s = solve_by_conjugate_gradients(a, multigrid, b, 1e-6, 20, threads);
    CHECK(s.x[14] == 0);
    CHECK(s.x[201] == 0);
    if (first.empty()) first = s.x;
    CHECK(s.x == first);
  }
}
