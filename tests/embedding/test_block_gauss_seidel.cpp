#include <catch2/catch.hpp>
#include <cmath>

#include "elastic_network.h"
#include "embedding/multigrid/block_gauss_seidel.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE("order_sweeps: every block once, no two of a colour share an entry") {
  const Network network(icosphere(4));
  const SweepOrder& order = network.order;
  std::vector<int> seen(order.first_row.size() - 1, 0), colour_of(seen.size());
  for (size_t c = 0; c + 1 < order.colour_start.size(); ++c) {
    for (int k = order.colour_start[c]; k < order.colour_start[c + 1]; ++k) {
      const auto block = static_cast<size_t>(order.blocks[static_cast<size_t>(k)]);
      ++seen[block];
      colour_of[block] = static_cast<int>(c);
    }
  }
  CHECK(seen == std::vector<int>(seen.size(), 1));
  for (int r = 0; r < network.matrix.rows(); ++r) {
    for (int e = network.matrix.start[static_cast<size_t>(r)];
         e < network.matrix.start[static_cast<size_t>(r) + 1]; ++e) {
      const auto other = static_cast<size_t>(network.matrix.column[static_cast<size_t>(e)] / 64);
      const auto own = static_cast<size_t>(r / 64);
      if (other != own && colour_of[other] == colour_of[own]) FAIL("blocks of a colour touch");
    }
  }
}

TEST_CASE(
    "sweep: the row that is solved last holds, forward and backward, at any number of threads") {
  const Network network(icosphere(4), 1e-3);
  const SweepOrder& order = network.order;
  const Unknowns b = random_vector(network.size(), 1);
  for (const Sweep direction : {Sweep::Forward, Sweep::Backward}) {
    Unknowns x = random_vector(network.size(), 2), other = x, rest(x.size());
    sweep(network.matrix, SmallInverses{}, order, b.data(), x.data(), direction, 1);
    sweep(network.matrix, SmallInverses{}, order, b.data(), other.data(), direction, 3);
    CHECK(x == other);
    residual(network.matrix, b.data(), x.data(), rest.data(), 1);
    const auto last = direction == Sweep::Forward
                          ? at(order.first_row[at(order.blocks.back()) + 1]) - 1
                          : at(order.first_row[at(order.blocks.front())]);
    CHECK(std::abs(rest[2 * last]) < 1e-9);
    CHECK(std::abs(rest[2 * last + 1]) < 1e-9);
    CHECK(dot(rest, rest) > 1e-3 * dot(b, b));  // one sweep does not solve the others
  }
}

TEST_CASE("sweep: inverses that are stored do as those made on the way") {
  const Network network(icosphere(3), 1e-3);
  std::vector<Block<2>> inverses;
  invert(network.matrix.diagonal, inverses, 1);
  const Unknowns b = random_vector(network.size(), 1);
  Unknowns x(b.size(), 0.0), y = x;
  sweep(network.matrix, SmallInverses{}, network.order, b.data(), x.data(), Sweep::Forward, 1);
  sweep(network.matrix, inverses, network.order, b.data(), y.data(), Sweep::Forward, 1);
  for (size_t i = 0; i < x.size(); ++i) CHECK(x[i] == Approx(y[i]).margin(1e-10));
}
