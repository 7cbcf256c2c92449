#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "chart/longitude.h"
#include "chart/planar_orientation.h"

using namespace sphparam;

namespace {

using Rational = boost::multiprecision::cpp_rational;

int sign_of(const Rational& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

int rational_orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
  const Rational au(a.u), av(a.v), bu(b.u), bv(b.v), cu(c.u), cv(c.v);
  return sign_of((bv - av) * (cu - au) - (bu - au) * (cv - av));
}

}  // namespace

TEST_CASE("planar orientation: a face seen from outside is positive though v points south") {
  // North-west, south-west, south-east: counter-clockwise on the sphere.
  CHECK(planar_orientation({0.2, 0.2}, {0.2, 0.6}, {0.5, 0.6}) == 1);
  CHECK(planar_orientation({0.2, 0.2}, {0.5, 0.6}, {0.2, 0.6}) == -1);
  CHECK(planar_orientation({0.25, 0.25}, {0.5, 0.5}, {0.75, 0.75}) == 0);
}

TEST_CASE("planar orientation: near-degenerate triangles agree with rational arithmetic") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  int flat = 0;
  for (int i = 0; i < 5000; ++i) {
    const double scale = i % 3 == 0 ? std::ldexp(1.0, -static_cast<int>(random() % 600)) : 1;
    const ChartPoint a{uniform(random), scale * uniform(random)};
    const ChartPoint b{uniform(random), scale * uniform(random)};
    const double t = i % 2 ? 0.5 : uniform(random);
    ChartPoint c{a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
    for (int n = static_cast<int>(random() % 3); n > 0; --n) c.v = std::nextafter(c.v, 2.0);
    flat += rational_orientation(a, b, c) == 0;
    REQUIRE(planar_orientation(a, b, c) == rational_orientation(a, b, c));
    REQUIRE(planar_orientation(c, b, a) == -rational_orientation(a, b, c));
  }
  CHECK(flat > 10);
}

TEST_CASE("meridian: an edge crosses θ = 0, θ = π, or neither, exactly") {
  const Vector3 front_west(1, -1, 0.3), front_east(1, 2, 0.1), back_east(-1, 1, 0);
  CHECK(crosses_meridian(front_west, front_east));
  CHECK(crosses_meridian(front_east, front_west));
  CHECK_FALSE(crosses_meridian(front_east, back_east));
  CHECK_FALSE(crosses_meridian(Vector3(-1, -1, 0), back_east));
  CHECK_FALSE(crosses_meridian(Vector3(1, 0, 0), front_east));  // ends on it
  CHECK_FALSE(crosses_meridian(Vector3(1, -1, 1), back_east));  // goes through ±z
  const Vector3 before_pole(1, std::nextafter(-1, 0.0), 1);     // passes it in front
  CHECK(crosses_meridian(before_pole, back_east));
  const Crossing crossing = meridian_crossing(before_pole, back_east);
  CHECK(on_meridian(crossing.point));
  CHECK(crossing.t == Approx(0.5));
}

TEST_CASE("chart point: inside the rectangle, but on the meridian and at ±z") {
  CHECK(chart_point({1, 0, 0}).u == 0);
  CHECK(chart_point({1, -0.0, 0}).u == 0);
  CHECK(chart_point({-1, 0, 0}).u == 0.5);
  CHECK(chart_point({-1, -0.0, 0}).u == 0.5);
  CHECK(chart_point({1, -1e-300, 0}).u < 1);
  CHECK(chart_point({1, 1e-320, 0}).u > 0);
  CHECK(chart_point({1e-200, 1e-200, 1}).v > 0);
  CHECK(chart_point({1e-200, 1e-200, -1}).v < 1);
  CHECK(chart_point({0, -0.0, -2}).v == 1);
  CHECK(chart_point({0, 1, 0}).u == 0.25);
  CHECK(chart_point({0, -1, 0}).u == 0.75);
}
