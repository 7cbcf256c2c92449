#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sphparam/io/coef_file.h"
#include "sphparam/io/read_options.h"
#include "sphparam/sphere/first_order_alignment.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using Catch::Contains;

namespace {

Functions some(int degree) {
  Functions c((degree + 1) * (degree + 1), 3);
  for (Eigen::Index i = 0; i < c.size(); ++i) c.data()[i] = std::sin(1.0 + 7 * double(i));
  return c;
}

/// The numbers of a .coef, in order, as C reads them.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (const char* at = text.c_str(); *at;) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end != at) numbers.push_back(value);
    at = end == at ? at + 1 : end;
  }
  return numbers;
}

}  // namespace

TEST_CASE(
    "coef_file: coefficients belong to functions with the Condon-Shortley phase, without √2") {
  const Functions c = some(6);
  const std::vector<double> numbers = numbers_in(to_coef(c));
  REQUIRE(numbers.size() == 1 + 3 * 49);
  CHECK(numbers[0] == 49);
  const TriangleMesh sphere = icosphere(1);
  const Functions wanted = synthesise(c, sphere.positions);
  for (Vertex v = 0; v < sphere.vertex_count(); ++v) {
    const Vector3 u = sphere.position(v);
    const double polar = std::acos(u.z()), azimuth = std::atan2(u.y(), u.x());
    Vector3 sum = Vector3::Zero();
    for (unsigned l = 0; l <= 6; ++l) {
      for (unsigned m = 0; m <= l; ++m) {
        const double y =
            std::sph_legendre(l, m, polar);  // with the phase (C++ [sf.cmath.sph.legendre])
        const auto at = [&](unsigned row) { return Vector3(&numbers[1 + 3 * row]); };
        if (m == 0) sum += y * at(l * l);
        if (m > 0) sum += y * std::cos(m * azimuth) * at(l * l + 2 * m - 1);
        if (m > 0) sum += y * std::sin(m * azimuth) * at(l * l + 2 * m);
      }
    }
    CHECK((sum.transpose() - wanted.row(v)).norm() < 1e-12);
  }
}

TEST_CASE("coef_file: of an aligned surface the first order is positive, long axis first") {
  Functions c = some(4) * 0.05;
  c(harmonic_index(1, 0), 1) = 5;  // the pole at the end of the longest axis, which is y
  c(harmonic_index(1, 1), 0) = -3;
  c(harmonic_index(1, -1), 2) = 2;
  const std::vector<double> n = numbers_in(to_coef(aligned(c, first_order_alignment(c), true)));
  const auto at = [&](int row, int k) { return n[size_t(1 + 3 * row + k)]; };
  CHECK(at(2, 0) > at(3, 1));  // cos θ: x, of the longest; sin θ: y
  CHECK(at(3, 1) > std::numbers::sqrt2 * at(1, 2));
  CHECK(at(1, 2) > 0);
  for (const auto& [row, k] : {std::pair(1, 0), {1, 1}, {2, 1}, {2, 2}, {3, 0}, {3, 2}, {0, 0}})
    CHECK(std::abs(at(row, k)) < 1e-13);
}

TEST_CASE("coef_file: what is written is read back, and a file of SPHARM-PDM is read") {
  const Functions c = some(5);
  CHECK((parse_coef(to_coef(c), "x.coef") - c).cwiseAbs().maxCoeff() < 1e-15);
  const Functions first = parse_coef(
      "{ 4,{1.500000, 0.000000, -2.000000},\n{0.000000, 0.000000, 3.000000},\n"
      "{1.000000, 0.000000, 0.000000},\n{0.000000, 2.000000, 0.000000}}",
      "a.coef");
  CHECK(first(0, 0) == 1.5);
  CHECK(first(harmonic_index(1, 0), 2) == 3);
  CHECK(first(harmonic_index(1, 1), 0) == Approx(-std::sqrt(0.5)));
  CHECK(first(harmonic_index(1, -1), 1) == Approx(-std::sqrt(2)));
}

TEST_CASE("coef_file: what is none is refused with the line") {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      parse_coef(text, "x.coef");
    } catch (const ReadError& error) {
      return error.what();
    }
    return "nothing";
  };
  CHECK_THAT(complaint(""), Contains("no coefficients"));
  CHECK_THAT(complaint("ply"), Contains("no coefficients"));
  CHECK_THAT(complaint("{ 5,{1, 2, 3}"), Contains("5 coefficients are no (L + 1)²"));
  CHECK_THAT(complaint("{ 1e30,{1, 2, 3}"), Contains("are no (L + 1)²"));
  CHECK_THAT(complaint("{ 4,{1, 2, 3},\n{1, 2, 3}}"), Contains("ends before") && Contains(":2"));
  CHECK_THAT(complaint("{ 1,{1, 2, 3},\n{1, 2, 3}}"), Contains("more after the last"));
  CHECK_THAT(complaint("{ 1,{1, x, 3}}"), Contains("x.coef:1"));
}
