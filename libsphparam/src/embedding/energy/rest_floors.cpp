#include "embedding/energy/rest_floors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "sphparam/parallel.h"

// With c added to the squares of all three edges, a·b grows by c/2, and of the area
//   4F² = |a × b|²  by  c (|a|² + |b|² − a·b) + ¾c²:
// sums of what is not negative, so that no needle is lost to rounding.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;
constexpr double many = 0.03, fatter = 2;  // times the area

/// The squared edge of an equilateral triangle.
double squared_edge(double area) { return 4 / std::numbers::sqrt3 * area; }

}  // namespace

Fatness::Fatness(double part, double faces)
    : mu(part),
      relative(mu * mu * 4 / 3),
      absolute(mu * mu * squared_edge(4 * std::numbers::pi / faces)) {}

RestTriangle fattened(const RestTriangle& triangle, const Fatness& fatness) {
  const double base = 1 / triangle.inverse_base, height = 1 / triangle.inverse_height;
  const double foot = triangle.foot * base, ab = foot * base;
  const double aa = base * base, half_sum = aa + foot * foot + height * height - ab;
  const double c = fatness.added(half_sum), new_base = std::sqrt(aa + c);
  const double area = std::sqrt(aa * height * height + c * (half_sum + 0.75 * c)) / 2;
  return {area, 1 / new_base, new_base / (2 * area), (ab + c / 2) / (aa + c)};
}

RestTriangles fattened(RestTriangles source, double mu, int threads) {
  if (mu == 0) return source;
  const Fatness fatness(mu, static_cast<double>(source.size()));
  parallel_for(std::ssize(source), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto f = static_cast<size_t>(first); f < static_cast<size_t>(last); ++f) {
      source[f] = fattened(source[f], fatness);
    }
  });
  return source;
}

bool has_slivers(const RestTriangles& source) {
  const Fatness fatness(fattening, static_cast<double>(source.size()));
  const auto slivers = std::ranges::count_if(source, [&](const RestTriangle& triangle) {
    return fattened(triangle, fatness).area > fatter * triangle.area;
  });
  return static_cast<double>(slivers) > many * static_cast<double>(source.size());
}

RestTriangle rest_triangle(const Vector3& a, const Vector3& b, const RestFloors& floors) {
  const double area = a.cross(b).norm() / 2, base = a.norm();
  RestTriangle rest{area, 1 / base, base / (2 * area), a.dot(b) / (base * base)};
  if (!(area > floors.area)) {
    const double edge = std::sqrt(squared_edge(floors.area));
    rest = {floors.area, 1 / edge, edge / (2 * floors.area), 0.5};
  }
  return floors.fatness.is_none() ? rest : fattened(rest, floors.fatness);
}

}  // namespace sphparam
