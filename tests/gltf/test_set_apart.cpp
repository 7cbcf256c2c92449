#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "gltf/format/packing.h"
#include "gltf/set_apart.h"

namespace sphparam::tests {

namespace {

/// The cells that positions are packed into.
std::set<std::tuple<double, double, double>> cells_of(const FloatRows& positions) {
  const Quantisation steps = quantisation_of(positions);
  std::set<std::tuple<double, double, double>> cells;
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const auto cell = [&](int k) {
      return std::round((static_cast<double>(positions(v, k)) - steps.offset[k]) / steps.scale);
    };
    cells.emplace(cell(0), cell(1), cell(2));
  }
  return cells;
}

/// A box of 65,535 steps of 1, and these.
FloatRows in_a_box(const std::vector<std::array<float, 3>>& places) {
  FloatRows rows(static_cast<Eigen::Index>(places.size()) + 2, 3);
  rows.row(0).setZero();
  rows.row(1).setConstant(65535);
  for (std::size_t i = 0; i < places.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i) + 2) << places[i][0], places[i][1], places[i][2];
  return rows;
}

}  // namespace

TEST_CASE("set_apart: places of one cell get cells of their own, copies stay together") {
  FloatRows rows = in_a_box({{100, 100, 100}, {100.4F, 100, 100}, {100.4F, 100, 100}, {7, 8, 9}});
  const FloatRows before = rows;
  CHECK(set_apart(rows) == 0);
  FloatRows expected = before;
  expected(3, 0) = expected(4, 0) = 101;  // the nearest cell to 100.4 but its own
  CHECK(rows == expected);
  CHECK(cells_of(rows).size() == 5);
  CHECK(set_apart(rows) == 0);
  CHECK(rows == expected);
}

TEST_CASE("set_apart: what is apart, or one place, is left as it is") {
  FloatRows rows = in_a_box({{3, 4, 5}, {3, 4, 5}, {4, 4, 5}, {0.0F, 9, 9}, {-0.0F, 9, 9}});
  const FloatRows before = rows;
  CHECK(set_apart(rows) == 0);
  CHECK(rows == before);
  FloatRows none(0, 3);
  CHECK(set_apart(none) == 0);
}

TEST_CASE("set_apart: bounds stay, and so do the cells of all others") {
  FloatRows rows = in_a_box({{0, 0.25F, 0.25F}, {65534.75F, 65535, 65535}});
  const FloatRows before = rows;
  CHECK(set_apart(rows) == 0);
  CHECK(cells_of(rows).size() == 4);
  CHECK(rows.colwise().minCoeff() == before.colwise().minCoeff());
  CHECK(rows.colwise().maxCoeff() == before.colwise().maxCoeff());
}

TEST_CASE("set_apart: a crowd finds room as far as there is some") {
  constexpr int fits = 9 * 9 * 9;  // cells about one
  std::vector<std::array<float, 3>> crowd;
  for (int i = 0; i < fits + 5; ++i)
    crowd.push_back({500 + 0.0005F * static_cast<float>(i), 500, 500});
  FloatRows rows = in_a_box(crowd);
  CHECK(set_apart(rows) == 5);
  CHECK(cells_of(rows).size() == fits + 2);
}

}  // namespace sphparam::tests
