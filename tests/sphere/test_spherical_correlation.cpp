#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "sphere/harmonic_turns.h"
#include "sphparam/sphere/spherical_correlation.h"

using namespace sphparam;

namespace {

using Matrix3 = Eigen::Matrix3d;

Functions random_functions(int degree, int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Functions c((degree + 1) * (degree + 1), count);
  for (Eigen::Index i = 0; i < c.size(); ++i) c.data()[i] = normal(random);
  return c;
}

Matrix3 random_rotation(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized().toRotationMatrix();
}

Matrix3 about(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Vector3::Unit(axis)).toRotationMatrix();
}

double angle_between(const Matrix3& a, const Matrix3& b) { return (a - b).norm() / std::sqrt(2.0); }

}  // namespace

TEST_CASE("harmonic_turns: turns about y, and generators about all axes, are those of functions") {
  const int degree = 6;
  const HarmonicTurns turns(degree);
  const Functions c = random_functions(degree, 2, 1);
  const Functions wanted = turn_harmonics(c, about(1, 0.7));
  for (int l = 0; l <= degree; ++l) {
    const auto first = harmonic_index(l, -l);
    const Eigen::MatrixXd rows = turns.about_y(l, 0.7) * c.middleRows(first, 2 * l + 1);
    CHECK((rows - wanted.middleRows(first, 2 * l + 1)).cwiseAbs().maxCoeff() < 1e-12);
  }
  const double step = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const Functions slope =
        (turn_harmonics(c, about(axis, step)) - turn_harmonics(c, about(axis, -step))) / (2 * step);
    CHECK((turns.generator(axis, c) - slope).cwiseAbs().maxCoeff() < 1e-6);
  }
}

TEST_CASE("spherical_correlation: a function that is another one turned is found, exactly") {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    for (const int degree : {2, 5, 16}) {
      const Functions from = random_functions(degree, 1, seed);
      const Matrix3 turn = random_rotation(seed);
      Functions to = 3 * turn_harmonics(from, turn);
      to.row(0).array() += 7;
      const auto found = turns_by_correlation(from, to);
      INFO("seed " << seed << ", degree " << degree);
      CHECK(found.front().correlation == Approx(1).epsilon(1e-12));
      // Degree 1 and 2 alone have half turns that leave them as they are, nearly.
      if (degree > 2) CHECK(angle_between(found.front().rotation, turn) < 1e-7);
    }
  }
}

TEST_CASE("spherical_correlation: several functions decide together, with noise on each") {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Functions from = random_functions(10, 3, seed);
    const Matrix3 turn = random_rotation(seed + 50);
    const Functions to = turn_harmonics(from, turn) + 0.8 * random_functions(10, 3, seed + 100);
    CHECK(angle_between(turns_by_correlation(from, to).front().rotation, turn) < 0.1);
  }
}

TEST_CASE("spherical_correlation: no rotation of a fine sample is better") {
  const Functions from = random_functions(4, 1, 3), to = random_functions(4, 1, 4);
  const auto found = turns_by_correlation(from, to);
  const auto correlation = [&](const Matrix3& turn) {
    Functions a = turn_harmonics(from, turn), b = to;
    a.row(0).setZero();
    b.row(0).setZero();
    return a.cwiseProduct(b).sum() / (a.norm() * b.norm());
  };
  for (const TurnOfFunctions& turn : found) {
    CHECK(correlation(turn.rotation) == Approx(turn.correlation).margin(1e-12));
    CHECK(turn.rotation.determinant() == Approx(1));
  }
  for (unsigned seed = 0; seed < 3000; ++seed)
    CHECK(correlation(random_rotation(seed)) <= found.front().correlation + 1e-12);
  for (size_t i = 1; i < found.size(); ++i) CHECK(found[i].correlation <= found[0].correlation);
}

TEST_CASE("spherical_correlation: of what is the same a third of a turn on, all three are found") {
  // Turns of it are apart by a third of a turn and more, and none is nearer than 20 degrees.
  Functions f = Functions::Zero(25, 1);
  f(harmonic_index(3, 3), 0) = 1;
  f(harmonic_index(4, 3), 0) = 0.7;
  f(harmonic_index(1, 0), 0) = 0.9;
  const auto found = turns_by_correlation(f, f, 40);
  int exact = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    exact += found[i].correlation > 1 - 1e-9;
    for (size_t j = 0; j < i; ++j) {
      const Matrix3 between = found[i].rotation.transpose() * found[j].rotation;
      CHECK(std::acos(std::min(1.0, (between.trace() - 1) / 2)) > std::numbers::pi / 9);
    }
  }
  CHECK(exact == 3);
}

TEST_CASE("spherical_correlation: functions known on parts are compared where both are") {
  const Matrix3 turn = random_rotation(3);
  const auto f = [](const Vector3& x) {
    return 4 + 2 * x.x() + std::sin(4 * x.y() + 1) * std::cos(3 * x.z()) + 0.5 * x.z() * x.y();
  };
  const auto part = [&](const Matrix3& back, const auto& is_known) {
    const QuadratureGrid grid = quadrature_grid(12);
    Functions known(grid.directions.rows(), 1), values = known;
    for (Eigen::Index i = 0; i < known.rows(); ++i) {
      const Vector3 x = back * grid.directions.row(i).transpose();
      known(i, 0) = is_known(x) ? 1 : 0;
      values(i, 0) = is_known(x) ? f(x) : 0;
    }
    const auto harmonics = [&](const Functions& c) {
      return analyse(12, grid.directions, grid.weights, c);
    };
    return PartlyKnown{harmonics(known), harmonics(values), harmonics(values.cwiseAbs2())};
  };
  const auto all = [](const Vector3&) { return true; };
  const auto most = [](const Vector3& x) { return x.x() < 0.3; };
  const auto others = [](const Vector3& x) { return x.y() > -0.4; };
  const PartlyKnown whole = part(Matrix3::Identity(), all);
  const PartlyKnown without = part(Matrix3::Identity(), most);
  for (const PartlyKnown& to : {part(turn.transpose(), all), part(turn.transpose(), most),
                                part(turn.transpose(), others)}) {
    for (const PartlyKnown* const from : {&whole, &without}) {
      const auto found = turns_by_shared_correlation(*from, to, 4);
      REQUIRE(found.size() == 4);
      CHECK(angle_between(found[0].rotation, turn) < 0.2);  // of a grid of 0.13
      CHECK(found[0].correlation > 0.8);
      for (size_t i = 1; i < 4; ++i) CHECK(found[i].correlation <= found[i - 1].correlation);
    }
  }
  const PartlyKnown none{Functions::Zero(169, 1), Functions::Zero(169, 1), Functions::Zero(169, 1)};
  CHECK(turns_by_shared_correlation(whole, none).empty());
  CHECK_THROWS_AS(turns_by_shared_correlation(whole, {whole.known, whole.values, {}}),
                  std::invalid_argument);
}

TEST_CASE("spherical_correlation: the same bits for any number of threads, nonsense is refused") {
  const Functions from = random_functions(12, 2, 3), to = random_functions(12, 2, 4);
  const auto one = turns_by_correlation(from, to, 3, 1),
             three = turns_by_correlation(from, to, 3, 3);
  REQUIRE(one.size() == three.size());
  for (size_t i = 0; i < one.size(); ++i) CHECK(one[i].rotation == three[i].rotation);
  CHECK_THROWS_AS(turns_by_correlation(from, to.leftCols(1)), std::invalid_argument);
  CHECK_THROWS_AS(turns_by_correlation(from, to, 0), std::invalid_argument);
  CHECK_THROWS_AS(turns_by_correlation(from.topRows(1), to.topRows(1)), std::invalid_argument);
  CHECK_THROWS_WITH(turns_by_correlation(from.topRows(8), to.topRows(8)),
                    "spherical correlation: 8 coefficients are no (L + 1)² of a degree L ≥ 1");
  CHECK_THROWS_WITH(turns_by_correlation(Functions::Zero(16, 1), random_functions(3, 1, 1)),
                    Catch::Contains("constant"));
}
