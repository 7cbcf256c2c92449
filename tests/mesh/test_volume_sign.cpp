#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "mesh/volume_sign.h"

namespace sphparam::tests {
namespace {

using Rational = boost::multiprecision::cpp_rational;

int sign_of(const Rational& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The oracle: rational arithmetic, sharing no code with the predicate.
int rational_volume(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const auto from_a = [&](const Vector3& p, int k) { return Rational(p[k]) - Rational(a[k]); };
  Rational sum = 0;
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    sum += from_a(b, k) * (from_a(c, u) * from_a(d, v) - from_a(c, v) * from_a(d, u));
  }
  return sign_of(sum);
}

int rational_area(const Vector3& a, const Vector3& b, const Vector3& c, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto from_a = [&](const Vector3& p, int k) { return Rational(p[k]) - Rational(a[k]); };
  return sign_of(from_a(b, u) * from_a(c, v) - from_a(b, v) * from_a(c, u));
}

struct Draw {
  std::mt19937_64 random{1};
  std::uniform_real_distribution<double> uniform{-1, 1};
  Vector3 point() { return {uniform(random), uniform(random), uniform(random)}; }
  /// A weighted mean, but for rounding and a few units in the last place.
  Vector3 beside(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double s = uniform(random), t = uniform(random);
    Vector3 p = (1 - s - t) * a + s * b + t * c;
    for (int k = 0; k < 3; ++k)
      for (int n = static_cast<int>(random() % 3); n > 0; --n) p[k] = std::nextafter(p[k], 2.0);
    return p;
  }
};

}  // namespace

TEST_CASE("volume sign: of axes and their end, and seen along axes") {
  const Vector3 o = Vector3::Zero(), x = Vector3::UnitX(), y = Vector3::UnitY(),
                z = Vector3::UnitZ();
  CHECK(volume_sign(o, x, y, z) == 1);
  CHECK(volume_sign(o, y, x, z) == -1);
  CHECK(volume_sign(o, x, y, x + y) == 0);
  CHECK(area_sign(o, x, y, 2) == 1);
  CHECK(area_sign(o, y, z, 0) == 1);
  CHECK(area_sign(o, z, x, 1) == 1);
  CHECK(area_sign(o, x, z, 1) == -1);
  CHECK(area_sign(o, x, y, 0) == 0);
}

TEST_CASE("volume sign: four points nearly in a plane agree with rational arithmetic") {
  Draw draw;
  int in_plane = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 a = draw.point(), b = draw.point(), c = draw.point();
    const Vector3 d = i % 4 == 0 ? Vector3(a + (b - a) / 2) : draw.beside(a, b, c);
    const double scale = i % 2 ? 1.0 : std::ldexp(1.0, static_cast<int>(draw.random() % 120) - 60);
    const int expected = rational_volume(scale * a, scale * b, scale * c, scale * d);
    in_plane += expected == 0;
    REQUIRE(volume_sign(scale * a, scale * b, scale * c, scale * d) == expected);
    REQUIRE(area_sign(a, b, a + (b - a) / 3, i % 3) == rational_area(a, b, a + (b - a) / 3, i % 3));
  }
  CHECK(in_plane > 0);
  CHECK(in_plane < 20000);
}

TEST_CASE("volume sign: what is too small for a filter keeps its sign") {
  const Vector3 o = Vector3::Zero(), x = Vector3::UnitX(), y = Vector3::UnitY(),
                z = Vector3::UnitZ();
  for (const double size : {1e-100, 1e-300, 0x1p-1074}) {
    CHECK(volume_sign(o, size * x, size * y, size * z) == 1);
    CHECK(volume_sign(o, x, y, -size * z) == -1);
    CHECK(volume_sign(size * x, o, y, 0x1p60 * z) == -1);
    CHECK(area_sign(o, size * x, size * y, 2) == 1);
    CHECK(area_sign(x, o, size * y - x, 2) == -1);
  }
}

}  // namespace sphparam::tests
