#include <catch2/catch.hpp>
#include <random>

#include "rays/flat_normal.h"
#include "rays/triangle_distance.h"

namespace sphparam {

namespace {

/// By brute force: the nearest of a fine grid of points of the triangle.
double grid_distance(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c,
                     int steps) {
  double best = (p - a).norm();
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const Vector3 point = a + (b - a) * i / steps + (c - a) * j / steps;
      best = std::min(best, (p - point).norm());
    }
  }
  return best;
}

struct Random {
  std::mt19937 bits{7};
  double number() { return std::uniform_real_distribution<double>(-1, 1)(bits); }
  Vector3 point() { return {number(), number(), number()}; }
};

void check_against_grid(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const TrianglePoint found = nearest_on_triangle(p, a, b, c);
  const double distance = std::sqrt(found.squared_distance);
  const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
  const double grid = grid_distance(p, a, b, c, 40);
  CHECK(distance <= grid + 1e-12);
  CHECK(distance >= grid - longest / 40);
  // The weights name the point at that distance, and are those of a point of the triangle.
  const Vector3& w = found.barycentric;
  CHECK((w[0] * a + w[1] * b + w[2] * c - p).norm() == Approx(distance).margin(1e-12));
  CHECK(w.minCoeff() >= -1e-15);
  CHECK(w.sum() == Approx(1));
}

}  // namespace

TEST_CASE("nearest_on_triangle: never beaten by a grid of points, for any triangle") {
  Random random;
  for (int i = 0; i < 200; ++i) {
    check_against_grid(2 * random.point(), random.point(), random.point(), random.point());
  }
}

TEST_CASE("nearest_on_triangle: needles, segments and points are what they are") {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const Vector3 a = random.point(), b = random.point(), p = random.point();
    const double t = random.number();
    const Vector3 on_line = a + t * (b - a);
    check_against_grid(p, a, b, on_line);                          // as good as a segment
    check_against_grid(p, a, b, on_line + 1e-9 * random.point());  // a sliver
    check_against_grid(p, a, a, b);
    check_against_grid(p, a, b, b);
    check_against_grid(p, a, a, a);
  }
}

TEST_CASE("nearest_on_triangle: the foot of the perpendicular, a side or a corner") {
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  CHECK(nearest_on_triangle({0.25, 0.25, 3}, a, b, c).squared_distance == 9);
  CHECK(nearest_on_triangle({0.5, -2, 0}, a, b, c).squared_distance == 4);
  CHECK(nearest_on_triangle({-3, -4, 0}, a, b, c).squared_distance == 25);
  CHECK(nearest_on_triangle({1, 1, 0}, a, b, c).squared_distance == 0.5);
  CHECK(nearest_on_triangle(c, a, b, c).squared_distance == 0);
}

TEST_CASE("nearest_on_triangle: the same weights at every size whose squares are numbers") {
  Random random;
  for (int i = 0; i < 50; ++i) {
    const Vector3 a = random.point(), b = random.point(), c = random.point();
    const Vector3 p = (a + b + c) / 3 + 0.1 * random.point();
    const TrianglePoint unit = nearest_on_triangle(p, a, b, c);
    for (const int exponent : {-480, -300, -240, 240, 300, 480}) {
      INFO("2^" << exponent);
      const double size = std::ldexp(1.0, exponent);
      const TrianglePoint found = nearest_on_triangle(size * p, size * a, size * b, size * c);
      CHECK(found.barycentric == unit.barycentric);
      CHECK(found.squared_distance == unit.squared_distance * size * size);
    }
  }
}

TEST_CASE("flat_normal: the same unit vector at every size that doubles have, 0 without area") {
  const Vector3 a(0.25, 0.5, 1), b(1, -0.5, 0.125), c(-0.75, 0.5, -1);
  const Vector3 normal = flat_normal(a, b, c);
  CHECK(normal.norm() == Approx(1));
  CHECK(std::abs(normal.dot(b - a)) < 1e-15);
  CHECK(std::abs(normal.dot(c - a)) < 1e-15);
  for (const int exponent : {-1050, -700, 700, 1023}) {
    INFO("2^" << exponent);
    const auto sized = [&](const Vector3& p) -> Vector3 {
      return p.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    };
    CHECK(flat_normal(sized(a), sized(b), sized(c)) == normal);
  }
  CHECK(flat_normal(a, b, b) == Vector3::Zero());
  CHECK(flat_normal(1e300 * a, 1e300 * a, 1e300 * a) == Vector3::Zero());
}

}  // namespace sphparam
