#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "sphparam/sphere/orientation.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

using namespace sphparam;

namespace {

/// The oracle: rational arithmetic, sharing no code with the predicate.
int rational_sign(const Vector3& a, const Vector3& b, const Vector3& c) {
  using Rational = boost::multiprecision::cpp_rational;
  const auto r = [](double x) { return Rational(x); };
  const Rational det = r(a[0]) * (r(b[1]) * r(c[2]) - r(b[2]) * r(c[1])) -
                       r(a[1]) * (r(b[0]) * r(c[2]) - r(b[2]) * r(c[0])) +
                       r(a[2]) * (r(b[0]) * r(c[1]) - r(b[1]) * r(c[0]));
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

}  // namespace

TEST_CASE("orientation: the axes run counter-clockwise") {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  CHECK(orientation(x, y, z) == 1);
  CHECK(orientation(y, x, z) == -1);
  CHECK(orientation(x, y, x + y) == 0);
}

TEST_CASE("orientation: near-degenerate triples agree with rational arithmetic") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  int exactly_flat = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 a = vector(), b = vector();
    // In the plane of a and b but for rounding and a few units in the last place.
    Vector3 c = uniform(random) * a + uniform(random) * b;
    for (int k = 0; k < 3; ++k) {
      for (int n = static_cast<int>(random() % 3); n > 0; --n) c[k] = std::nextafter(c[k], 2.0);
    }
    if (i % 4 == 0) c = 2 * a;
    const double scale = i % 2 ? 1.0 : std::ldexp(1.0, static_cast<int>(random() % 120) - 60);
    exactly_flat += rational_sign(a, b, c) == 0;
    REQUIRE(orientation(a, b, scale * c) == rational_sign(a, b, scale * c));
    REQUIRE(exact_orientation(a, b, c) == rational_sign(a, b, c));
  }
  CHECK(exactly_flat >= 5000);
}

TEST_CASE("orientation: tiny and huge rays take the exact path and keep their sign") {
  const Vector3 a(1, 0, 0), b(0.5, 1, 0), c(0.25, 0.25, 1);
  for (const double scale : {1e-300, 0x1p-1074, 0x1p60}) {
    CHECK(orientation(scale * a, b, c) == 1);
    CHECK(orientation(b, scale * a, scale * c) == -1);
    CHECK(orientation(scale * a, scale * a, c) == 0);
  }
}

TEST_CASE("orientation: swapping two rays turns the sign, rotating them does not") {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  for (int i = 0; i < 1000; ++i) {
    const Vector3 a = vector(), b = vector(), c = i % 3 ? vector() : Vector3(a + b);
    REQUIRE(orientation(a, b, c) == orientation(b, c, a));
    REQUIRE(orientation(a, b, c) == -orientation(b, a, c));
  }
}

#ifdef __SSE2__
TEST_CASE(
    "orientation: signs hold in programs that flush subnormal numbers, as -ffast-math has it") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  // Products that underflow, beside others that make the filter's permanent large enough.
  const auto entry = [&] {
    return std::ldexp(uniform(random),
                      -(std::array{0, 0, 500, 540, 900, 1030, 1060})[random() % 7]);
  };
  const auto vector = [&] { return Vector3(entry(), entry(), entry()); };
  for (int i = 0; i < 20000; ++i) {
    const Vector3 a = vector(), b = vector(), c = i % 3 ? vector() : Vector3(a + b);
    const Vector3 large = 0x1p64 * a;
    const int sign = rational_sign(a, b, c);
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040);  // results and operands
    const int flushed = orientation(a, b, c), exact = exact_orientation(a, b, c);
    const int of_large = orientation(large, b, c);
    _mm_setcsr(mode);
    REQUIRE(flushed == sign);
    REQUIRE(exact == sign);
    REQUIRE(of_large == rational_sign(large, b, c));
  }
}
#endif
