#include <algorithm>
#include <catch2/catch.hpp>

#include "elastic_network.h"
#include "embedding/multigrid/aggregates.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

TEST_CASE(
    "aggregate: every row but the pinned ones is in one aggregate, together with a neighbour") {
  Network network(icosphere(4));
  BlockMatrix<2>& a = network.matrix;
  std::vector<char> pinned(network.points.size(), 0);
  pinned[3] = pinned[77] = 1;
  for (int row = 0; row < a.rows(); ++row) {
    for (int e = a.start[at(row)]; e < a.start[at(row) + 1]; ++e) {
      if (pinned[at(row)] || pinned[at(a.column[at(e)])]) a.off[at(e)] = {};
    }
  }
  const Aggregates aggregates = aggregate(a, pinned, 0.05);
  CHECK(aggregates.count() < a.rows() / 3);
  CHECK(aggregates.members.size() == at(a.rows()) - 2);
  std::vector<int> seen(at(a.rows()), 0);
  for (int c = 0; c < aggregates.count(); ++c) {
    for (int m = aggregates.start[at(c)]; m < aggregates.start[at(c) + 1]; ++m) {
      const int row = aggregates.members[at(m)];
      ++seen[at(row)];
      CHECK(aggregates.of_row[at(row)] == c);
      const auto first = a.column.begin() + a.start[at(row)];
      const auto last = a.column.begin() + a.start[at(row) + 1];
      CHECK(std::any_of(first, last, [&](int j) { return aggregates.of_row[at(j)] == c; }));
    }
  }
  for (size_t row = 0; row < seen.size(); ++row) CHECK(seen[row] == (pinned[row] ? 0 : 1));
}

TEST_CASE("aggregate: no aggregate reaches across weak connections, unless all count") {
  Network network(icosphere(4));
  BlockMatrix<2>& a = network.matrix;
  const auto north = [&](int row) { return network.points[at(row)].z > 0; };
  for (int row = 0; row < a.rows(); ++row) {
    for (int e = a.start[at(row)]; e < a.start[at(row) + 1]; ++e) {
      if (north(row) == north(a.column[at(e)])) continue;
      for (double& v : a.off[at(e)].a) v *= 1e-3;
    }
  }
  for (const double strength : {0.05, 0.0}) {
    const Aggregates aggregates = aggregate(a, {}, strength);
    int across = 0;
    for (int row = 0; row < a.rows(); ++row) {
      const int first = aggregates.members[at(aggregates.start[at(aggregates.of_row[at(row)])])];
      across += north(row) != north(first);
    }
    CHECK((across > 0) == (strength == 0));
  }
}
