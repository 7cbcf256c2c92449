#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "sphere/planar_orientation.h"

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
