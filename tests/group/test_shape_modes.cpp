#include <catch2/catch.hpp>
#include <cmath>

#include "sphparam/group/shape_modes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

VectorX weights_of(Eigen::Index count) {
  VectorX weights(count);
  for (Eigen::Index v = 0; v < count; ++v) weights[v] = 1 + double(v % 5);
  return weights / weights.sum();
}

double product(const Points& a, const Points& b, const VectorX& weights) {
  return a.cwiseProduct(b).rowwise().sum().dot(weights);
}

/// Two ways to vary, orthogonal in the mean with these weights only by chance.
struct Family {
  Points mean = icosphere(2).positions, one = mean, other = mean;
  VectorX weights = weights_of(mean.rows());
  std::vector<double> first{3, -1, 0.5, -2, -0.5}, second{0.1, 0.3, -0.5, 0.2, -0.1};
  std::vector<Points> shapes;

  Family() {
    one.rightCols(2).setZero();
    other.leftCols(2).setZero();
    for (size_t i = 0; i < first.size(); ++i)
      shapes.push_back(mean + first[i] * one + second[i] * other);
  }
};

}  // namespace

TEST_CASE("shape_modes: all modes together are the shapes, modes are orthogonal, scores normal") {
  const Family family;
  const ShapeModes found = shape_modes(family.shapes, family.mean, family.weights, 10);
  REQUIRE(found.modes.size() == 2);
  for (size_t i = 0; i < family.shapes.size(); ++i) {
    Points sum = family.mean;
    for (size_t k = 0; k < 2; ++k)
      sum += found.scores(Eigen::Index(i), Eigen::Index(k)) * found.modes[k];
    CHECK((sum - family.shapes[i]).cwiseAbs().maxCoeff() < 1e-12);
  }
  CHECK(std::abs(product(found.modes[0], found.modes[1], family.weights)) < 1e-12);
  for (int k = 0; k < 2; ++k) {
    CHECK(std::abs(found.scores.col(k).sum()) < 1e-12);
    CHECK(found.scores.col(k).squaredNorm() == Approx(4));
    CHECK(product(found.modes[size_t(k)], found.modes[size_t(k)], family.weights) ==
          Approx(found.deviations[k] * found.deviations[k]));
  }
  CHECK(found.deviations[0] > found.deviations[1]);
  CHECK(found.shares.sum() == Approx(1));
  double variance = 0;
  for (const Points& shape : family.shapes)
    variance += product(shape - family.mean, shape - family.mean, family.weights) / 4;
  CHECK(found.variance == Approx(variance));
}

TEST_CASE("shape_modes: a family of one parameter has one mode, whose scores are the parameter") {
  const Points mean = icosphere(2).positions;
  Points longer = mean;
  longer.rightCols(2).setZero();
  const std::vector<double> parameter{-1, 0, 4, -3};
  std::vector<Points> shapes;
  for (const double t : parameter) shapes.push_back(mean + t * longer);
  const ShapeModes found = shape_modes(shapes, mean, weights_of(mean.rows()), 3);
  REQUIRE(found.modes.size() == 1);
  CHECK(found.shares[0] == Approx(1));
  const double unit = std::sqrt((1 + 16 + 9) / 3.0);
  for (Eigen::Index i = 0; i < 4; ++i)
    CHECK(found.scores(i, 0) == Approx(parameter[size_t(i)] / unit).margin(1e-12));
  CHECK((along_mode(mean, found, 0, 2) - (mean + 2 * unit * longer)).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("shape_modes: as many as asked for, none of one shape and of copies") {
  const Family family;
  CHECK(shape_modes(family.shapes, family.mean, family.weights, 1).modes.size() == 1);
  const ShapeModes none = shape_modes(family.shapes, family.mean, family.weights, 0);
  CHECK(none.modes.empty());
  CHECK(none.variance > 0);
  CHECK(shape_modes({family.mean}, family.mean, family.weights, 3).modes.empty());
  CHECK(shape_modes({family.mean, family.mean, family.mean}, family.mean, family.weights, 3)
            .modes.empty());
  CHECK_THROWS_AS(shape_modes({}, family.mean, family.weights, 3), std::invalid_argument);
  CHECK_THROWS_AS(shape_modes(family.shapes, family.mean, family.weights, -1),
                  std::invalid_argument);
  CHECK_THROWS_AS(shape_modes(family.shapes, family.mean.topRows(2), family.weights, 1),
                  std::invalid_argument);
  CHECK_THROWS_AS(shape_modes(family.shapes, family.mean, 2 * family.weights, 1),
                  std::invalid_argument);
}

TEST_CASE("shape_modes: the same bits for any number of threads") {
  const Family family;
  const ShapeModes one = shape_modes(family.shapes, family.mean, family.weights, 3, 1);
  const ShapeModes three = shape_modes(family.shapes, family.mean, family.weights, 3, 3);
  CHECK(one.scores == three.scores);
  CHECK(one.modes[1] == three.modes[1]);
}
