#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>

#include "chart/longitude.h"

using namespace sphparam;

namespace {

Vector3 random_ray(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3(normal(random), normal(random), normal(random)).normalized();
}

double det(const Vector3& p, const Vector3& q) { return p.x() * q.y() - p.y() * q.x(); }

}  // namespace

TEST_CASE("meridian: where an edge meets a meridian is on both, whichever way the edge runs") {
  std::mt19937 random(1);
  int crossings = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 a = random_ray(random), b = random_ray(random), through = random_ray(random);
    const double shortest = 0.05;  // angles below that blow rounding up
    if (det(a, through) < shortest || det(through, b) < shortest || det(a, b) < shortest) continue;
    ++crossings;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      const Crossing crossing = meridian_crossing(from, to, through);
      const Vector3& p = crossing.point;
      CHECK(chart_point(p).u == Approx(chart_point(through).u).epsilon(1e-14));
      CHECK(std::abs(p.norm() - 1) < 1e-14);
      CHECK((crossing.t > 0 && crossing.t < 1));
      CHECK(((1 - crossing.t) * from + crossing.t * to).normalized().isApprox(p, 1e-12));
    }
  }
  CHECK(crossings > 1000);
}

TEST_CASE("meridian: crossings of θ = 0 are on it exactly, however near the ends are") {
  std::mt19937 random(2);
  for (const double scale : {1.0, 1e-8, 1e-16, 1e-300}) {
    for (int i = 0; i < 100; ++i) {
      Vector3 a = random_ray(random), b = random_ray(random);
      a.y() = -scale * std::abs(a.y());
      b.y() = scale * std::abs(b.y());
      if (!crosses_meridian(a, b)) continue;
      CHECK(on_meridian(meridian_crossing(a, b, Vector3::UnitX()).point));
      CHECK(on_meridian(meridian_crossing(b, a, Vector3::UnitX()).point));
    }
  }
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
  const Crossing crossing = meridian_crossing(before_pole, back_east, Vector3::UnitX());
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

TEST_CASE("longitude: chart points of many at once are those of one by one, to the bit") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<Vector3> rays = {
      {0, 0, 1},       {0, -0.0, -2},  {1, 0, 0},           {-1, 0, 0.5}, {-1, -0.0, 0},
      {1, -1e-300, 0}, {1, 1e-320, 0}, {1e-200, 1e-200, 1}, {1, 1, 0},    {1e-200, -1e-9, -1}};
  while (rays.size() < 333) rays.emplace_back(normal(random), normal(random), normal(random));
  std::vector<ChartPoint> points(rays.size());
  chart_points(rays, points);
  for (size_t i = 0; i < rays.size(); ++i) {
    INFO(rays[i].transpose());
    CHECK(points[i].u == chart_point(rays[i]).u);
    CHECK(points[i].v == chart_point(rays[i]).v);
  }
}
