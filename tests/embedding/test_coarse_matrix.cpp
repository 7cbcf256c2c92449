#include <catch2/catch.hpp>

#include "elastic_network.h"
#include "embedding/multigrid/coarse_matrix.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

std::vector<Block<2>> random_blocks(size_t count) {
  const Unknowns values = random_vector(4 * count, 5);
  std::vector<Block<2>> blocks(count);
  for (size_t i = 0; i < values.size(); ++i) blocks[i / 4].a[i % 4] = values[i];
  return blocks;
}

}  // namespace

TEST_CASE("coarse matrix: PᵀAP does what P, A and Pᵀ do one after the other") {
  const Network network(icosphere(4), 1e-3);
  const Aggregates aggregates = aggregate(network.matrix, {}, 0.05);
  const std::vector<Block<2>> p = random_blocks(network.points.size());
  BlockMatrix<2> coarse;
  make_pattern(network.matrix, aggregates, coarse);
  restrict_matrix(network.matrix, p, aggregates, coarse, 2);
  REQUIRE(coarse.rows() == aggregates.count());

  const Unknowns x = random_vector(2 * at(aggregates.count()), 6);
  Unknowns fine(network.size(), 0.0), image(fine.size()), expected(x.size()), found(x.size());
  prolong_vector(p, aggregates.of_row, x.data(), fine.data(), 2);
  multiply(network.matrix, fine.data(), image.data(), 2);
  restrict_vector(p, aggregates, image.data(), expected.data(), 2);
  multiply(coarse, x.data(), found.data(), 2);
  for (size_t i = 0; i < x.size(); ++i) CHECK(found[i] == Approx(expected[i]).margin(2e-4));
}

TEST_CASE("coarse matrix: Pᵀ is the transpose of P") {
  const Network network(icosphere(3));
  const Aggregates aggregates = aggregate(network.matrix, {}, 0.05);
  const std::vector<Block<2>> p = random_blocks(network.points.size());
  const Unknowns r = random_vector(network.size(), 1);
  const Unknowns y = random_vector(2 * at(aggregates.count()), 2);
  Unknowns restricted(y.size()), prolonged(r.size(), 0.0);
  restrict_vector(p, aggregates, r.data(), restricted.data(), 1);
  prolong_vector(p, aggregates.of_row, y.data(), prolonged.data(), 1);
  CHECK(dot(restricted, y) == Approx(dot(r, prolonged)).epsilon(1e-9));
}
