#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "sphparam/sphere/first_order_alignment.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

using Matrix3 = Eigen::Matrix3d;
constexpr double pi = std::numbers::pi;

Matrix3 rotation(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

const Matrix3 one_turn = rotation(1.1, Vector3(1, -2, 0.5)),
              other_turn = rotation(-0.7, Vector3(2, 1, 3));

/// An ellipsoid with bumps: x, y, z of degree 5, all half turns told apart.
Functions bumpy(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  Functions c(36, 3);
  for (Eigen::Index i = 0; i < c.size(); ++i) c.data()[i] = uniform(random);
  c.middleRows(1, 3).setZero();
  c(harmonic_index(1, 1), 0) = 6;
  c(harmonic_index(1, -1), 1) = 4;
  c(harmonic_index(1, 0), 2) = 2.5;
  return turn_harmonics(c, one_turn) * other_turn.transpose();
}

/// The surface turned and moved, its sphere turned.
Functions moved(const Functions& c, const Matrix3& sphere, const Matrix3& surface) {
  Functions result = turn_harmonics(c, sphere) * surface.transpose();
  result.row(0) += Vector3(5, -7, 11).transpose();
  return result;
}

Functions lying(const Functions& c, const Functions* flips = nullptr) {
  return aligned(c, first_order_alignment(c, flips), true);
}

}  // namespace

TEST_CASE("first_order_alignment: turned harmonics have the values of the turned sphere") {
  const Functions c = bumpy(1);
  const TriangleMesh sphere = icosphere(2);
  const Functions turned = turn_harmonics(c, one_turn);
  const Points there = sphere.positions * one_turn.transpose();
  CHECK((synthesise(turned, there) - synthesise(c, sphere.positions)).cwiseAbs().maxCoeff() <
        1e-12);
  CHECK((power_per_degree(turned) - power_per_degree(c)).cwiseAbs().maxCoeff() < 1e-11);
  CHECK((turn_harmonics(turned, one_turn.transpose()) - c).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE(
    "first_order_alignment: the first order is diagonal, long axis first, minus, minus, plus") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Functions c = bumpy(seed);
    const FirstOrderAlignment found = first_order_alignment(c);
    const Functions a = aligned(c, found, true);
    const double scale = std::sqrt(3 / (4 * pi));
    Matrix3 first;
    first << a.row(harmonic_index(1, 1)).transpose(), a.row(harmonic_index(1, -1)).transpose(),
        a.row(harmonic_index(1, 0)).transpose();
    const Vector3 wanted(-6, -4, 2.5);
    CHECK((first - Matrix3(wanted.asDiagonal())).cwiseAbs().maxCoeff() < 1e-12);
    CHECK((found.semi_axes - scale * wanted.cwiseAbs()).norm() < 1e-12);
    CHECK(a.row(0).norm() < 1e-12);
    CHECK(found.sphere.determinant() == Approx(1));
    CHECK(found.object.determinant() == Approx(1));
    CHECK_FALSE(found.reversed);
  }
}

TEST_CASE("first_order_alignment: coefficients do not depend on how surface and sphere lie") {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Functions c = bumpy(seed), wanted = lying(c);
    CHECK((lying(moved(c, one_turn, other_turn)) - wanted).cwiseAbs().maxCoeff() < 1e-11);
    CHECK((lying(moved(c, Matrix3::Identity(), one_turn)) - wanted).cwiseAbs().maxCoeff() < 1e-11);
    CHECK((lying(moved(c, other_turn, Matrix3::Identity())) - wanted).cwiseAbs().maxCoeff() <
          1e-11);
  }
}

TEST_CASE(
    "first_order_alignment: the aligned surface is the surface, turned, on the turned sphere") {
  const Functions c = bumpy(3);
  const FirstOrderAlignment found = first_order_alignment(c);
  const TriangleMesh sphere = icosphere(2);
  const Functions before = synthesise(c, sphere.positions);
  const Functions after =
      synthesise(aligned(c, found, true), Points(sphere.positions * found.sphere.transpose()));
  const Points turned = (before.rowwise() - found.centre.transpose()) * found.object.transpose();
  CHECK((after - turned).cwiseAbs().maxCoeff() < 1e-12);
  const Functions alone =
      synthesise(aligned(c, found, false), Points(sphere.positions * found.sphere.transpose()));
  CHECK((alone - before).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE(
    "first_order_alignment: the two greatest skewnesses are positive, as sums over the sphere") {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Functions c = bumpy(seed);
    const FirstOrderAlignment found = first_order_alignment(c);
    const Functions x = synthesise(aligned(c, found, true), quadrature_grid(20).directions);
    const VectorX w = quadrature_grid(20).weights;
    int negative = 0;
    double least_positive = 1e300, negative_size = 0;
    for (int k = 0; k < 3; ++k) {
      const double cubes = w.dot(x.col(k).array().cube().matrix());
      const double squares = w.dot(x.col(k).cwiseAbs2());
      const double skewness = cubes / std::pow(squares, 1.5) * std::sqrt(4 * pi);
      CHECK(found.skewness[k] == Approx(skewness).margin(1e-12));
      if (skewness < 0) ++negative, negative_size = -skewness;
      if (skewness > 0) least_positive = std::min(least_positive, skewness);
    }
    CHECK(negative <= 1);
    CHECK((negative == 0 || negative_size <= least_positive));
  }
}

TEST_CASE("first_order_alignment: flips of a template decide, whatever skewness says") {
  const Functions c = bumpy(4), usual = lying(c);
  const Functions same = 3 * usual;
  CHECK((lying(c, &same) - usual).cwiseAbs().maxCoeff() < 1e-11);
  for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}) {
    const Matrix3 half = rotation(pi, axis);
    const Functions other = turn_harmonics(usual, half) * half.transpose();
    CHECK((other - usual).cwiseAbs().maxCoeff() > 0.01);
    const Functions flips = 3 * other;  // of another size
    CHECK((lying(c, &flips) - other).cwiseAbs().maxCoeff() < 1e-11);
  }
  const Functions crooked = bumpy(4);
  CHECK_THROWS_WITH(lying(c, &crooked), Catch::Contains("not aligned"));
}

TEST_CASE("first_order_alignment: where a template tells no half turns apart skewness decides") {
  const auto diagonal = [] {
    Functions result = Functions::Zero(36, 3);
    result(harmonic_index(1, 1), 0) = -6;
    result(harmonic_index(1, -1), 1) = -4;
    result(harmonic_index(1, 0), 2) = 2.5;
    return result;
  };
  const Functions plain = diagonal();  // all half turns leave it as it is
  Functions nearly = plain;            // of all signs, and of no skewness that says so
  nearly.row(harmonic_index(2, -1)) = Eigen::RowVector3d(-0.004, 0.003, -0.005);
  nearly.row(harmonic_index(3, 2)) = Eigen::RowVector3d(0.004, -0.005, 0.003);
  for (const unsigned seed : {1u, 2u, 4u, 5u}) {
    CAPTURE(seed);
    const Functions c = bumpy(seed), usual = lying(c);
    REQUIRE(first_order_alignment(c).undecided == 0);
    for (const Functions& flips : {plain, nearly}) {
      const FirstOrderAlignment found = first_order_alignment(c, &flips);
      CHECK((aligned(c, found, true) - usual).cwiseAbs().maxCoeff() < 1e-11);
      CHECK(found.by_skewness);
      CHECK(found.confidence >= 0);
      CHECK(found.confidence < 0.02);
      CHECK(found.undecided == 0);
      CHECK_THAT(doubts_about(found).at(0), Catch::StartsWith("the template hardly tells") &&
                                                Catch::Contains("skewness along the axes decides"));
    }
    const FirstOrderAlignment clear = first_order_alignment(c, &usual);
    CHECK(clear.confidence == Approx(1).margin(1e-9));
    CHECK_FALSE(clear.by_skewness);
    CHECK(clear.undecided == 0);
    CHECK(doubts_about(clear).empty());
  }
  // Neither decides: the nearest stays, and it is told how far others are.
  const FirstOrderAlignment open = first_order_alignment(nearly, &plain);
  CHECK_FALSE(open.by_skewness);
  CHECK(open.confidence == Approx(0).margin(1e-9));
  CHECK(open.undecided > 1e-3);
  CHECK_THAT(doubts_about(open).at(0),
             Catch::StartsWith("the template hardly tells") && Catch::Contains("of their size"));
  // What no half turn changes needs none decided.
  const FirstOrderAlignment same = first_order_alignment(plain, &nearly);
  CHECK(same.confidence == 1);
  CHECK(same.undecided == 0);
}

TEST_CASE("first_order_alignment: skewness decides as a template of clear skewness lies") {
  const Functions c = bumpy(4), usual = lying(c);
  const Matrix3 half = rotation(pi, Vector3(0, 1, 0));
  // One that is far from all four, and lies against its own skewness.
  Functions far = lying(bumpy(2));
  far.bottomRows(far.rows() - 4) *= 40;
  far = lying(far);
  const Functions flips = turn_harmonics(far, half) * half.transpose();
  const FirstOrderAlignment found = first_order_alignment(c, &flips);
  REQUIRE(found.confidence < 0.1);
  REQUIRE(found.by_skewness);
  const Functions wanted = turn_harmonics(usual, half) * half.transpose();
  CHECK((aligned(c, found, true) - wanted).cwiseAbs().maxCoeff() < 1e-11);
}

TEST_CASE("first_order_alignment: what is flat along an axis has no skewness there") {
  Functions flat = Functions::Zero(9, 3);
  flat(harmonic_index(1, 1), 0) = 3;
  flat(harmonic_index(1, -1), 1) = 2;
  CHECK(first_order_alignment(flat).skewness.norm() < 1e-12);
}

TEST_CASE("first_order_alignment: the size of the surface decides nothing") {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Functions c = bumpy(seed), other = 3 * lying(bumpy(seed + 1));
    const FirstOrderAlignment skewed = first_order_alignment(c),
                              flipped = first_order_alignment(c, &other);
    for (const double size : {0x1p-400, 0x1p400}) {  // whose cubes are no numbers
      const Functions sized = size * c, template_sized = size * other;
      const FirstOrderAlignment found = first_order_alignment(sized);
      CHECK((found.skewness - skewed.skewness).norm() < 1e-12);
      CHECK((found.object - skewed.object).norm() < 1e-12);
      CHECK((first_order_alignment(sized, &template_sized).object - flipped.object).norm() < 1e-12);
    }
  }
}

TEST_CASE("first_order_alignment: what is not decided is told") {
  const auto diagonal = [](double a, double b, double c) {
    Functions result = Functions::Zero(9, 3);
    result(harmonic_index(1, 1), 0) = a;
    result(harmonic_index(1, -1), 1) = b;
    result(harmonic_index(1, 0), 2) = c;
    return result;
  };
  CHECK(doubts_about(first_order_alignment(diagonal(3, 2, 1))).empty());  // half turns are the same
  CHECK_THAT(doubts_about(first_order_alignment(diagonal(3, 2, 2))).at(0),
             Catch::Contains("as good as equal"));
  Functions odd = diagonal(3, 2, 1);
  odd(harmonic_index(2, -1), 2) = 0.3;  // changes sign with half turns, and has no skewness
  const FirstOrderAlignment found = first_order_alignment(odd);
  CHECK(found.undecided > 0.01);
  CHECK_THAT(doubts_about(found).at(0), Catch::Contains("signs of the axes"));
  const FirstOrderAlignment inside_out = first_order_alignment(diagonal(3, 2, -1));
  CHECK(inside_out.reversed);
  CHECK(inside_out.object.determinant() == Approx(1));
  CHECK(inside_out.sphere.determinant() == Approx(1));
  CHECK_THROWS_AS(first_order_alignment(Functions::Ones(1, 3)), std::invalid_argument);
}
