#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include "mesh/triangle_crossing.h"

namespace sphparam::tests {
namespace {

/// Whether an axis parts two triangles: what each has along it is apart, or touches, and not all of
/// both is at one place of it. Small integers: doubles are exact.
bool parts(const Vector3& axis, const TriangleCorners& s, const TriangleCorners& t) {
  std::array<double, 3> a, b;
  for (size_t k = 0; k < 3; ++k) a[k] = axis.dot(s[k]), b[k] = axis.dot(t[k]);
  std::ranges::sort(a);
  std::ranges::sort(b);
  if (std::min(a[0], b[0]) == std::max(a[2], b[2])) return false;
  return a[2] <= b[0] || b[2] <= a[0];
}

/// The oracle: relative insides of convex sets have no point in common where a plane parts them,
/// and of polytopes one of finitely many does. Requires: area.
bool have_insides_in_common(const TriangleCorners& s, const TriangleCorners& t) {
  const auto side = [](const TriangleCorners& c, size_t k) {
    return Vector3(c[(k + 1) % 3] - c[k]);
  };
  const Vector3 n = side(s, 0).cross(side(s, 1)), m = side(t, 0).cross(side(t, 1));
  std::vector<Vector3> axes{n, m};
  for (size_t i = 0; i < 3; ++i) {
    axes.push_back(n.cross(side(s, i)));
    axes.push_back(m.cross(side(t, i)));
    for (size_t k = 0; k < 3; ++k) axes.push_back(side(s, i).cross(side(t, k)));
  }
  return std::ranges::none_of(axes, [&](const Vector3& axis) { return parts(axis, s, t); });
}

bool has_area(const TriangleCorners& t) {
  return Vector3(t[1] - t[0]).cross(Vector3(t[2] - t[0])).norm() > 0;
}

/// Both ways, with corners in any order.
bool cross_any_way(TriangleCorners s, TriangleCorners t) {
  const bool first = triangles_cross(s, t);
  for (int turn = 0; turn < 3; ++turn) {
    CHECK(triangles_cross(s, t) == first);
    CHECK(triangles_cross(t, s) == first);
    std::swap(t[0], t[1]);
    CHECK(triangles_cross(s, t) == first);
    std::ranges::rotate(s, s.begin() + 1);
  }
  return first;
}

const TriangleCorners floor_triangle{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)};

}  // namespace

TEST_CASE("triangle crossing: all small triangles agree with planes that part them") {
  std::mt19937_64 random(1);
  for (const unsigned across : {2u, 3u, 7u}) {
    const auto corner = [&] {
      const auto number = [&] { return static_cast<double>(random() % across); };
      const double x = number(), y = number();
      return Vector3(x, y, number());
    };
    int crossing = 0, apart = 0;
    for (int i = 0; i < 20000; ++i) {
      const TriangleCorners s{corner(), corner(), corner()};
      TriangleCorners t{corner(), corner(), corner()};
      if (i % 4 == 1) t[0] = s[0];                 // a corner in common
      if (i % 4 == 2) t = {s[1], s[0], corner()};  // a side
      if (i % 4 == 3)
        for (Vector3& c : t) c.z() = s[0].z();
      const bool expected = has_area(s) && has_area(t) && have_insides_in_common(s, t);
      const bool found = cross_any_way(s, t);
      if (found != expected)
        FAIL(s[0].transpose() << "; " << s[1].transpose() << "; " << s[2].transpose() << " and "
                              << t[0].transpose() << "; " << t[1].transpose() << "; "
                              << t[2].transpose());
      ++(found ? crossing : apart);
    }
    CHECK(crossing > 500);
    CHECK(apart > 500);
  }
}

TEST_CASE("triangle crossing: sides and corners that touch do not cross") {
  const Vector3 up(0, 0, 1);
  // A corner on the inside, a side in the plane, a side through a corner.
  CHECK_FALSE(
      cross_any_way(floor_triangle, {Vector3(1, 1, 0), Vector3(1, 1, 2), Vector3(2, 1, 2)}));
  CHECK_FALSE(
      cross_any_way(floor_triangle, {Vector3(1, 1, 0), Vector3(2, 1, 0), Vector3(1, 1, 2)}));
  CHECK_FALSE(cross_any_way(floor_triangle, {Vector3(-up), up, Vector3(-1, 0, 0)}));
  // The same a little lower passes through it.
  CHECK(
      cross_any_way(floor_triangle, {Vector3(1, 1, -0x1p-60), Vector3(1, 1, 2), Vector3(2, 1, 2)}));
}

TEST_CASE("triangle crossing: beside a corner and a side in common") {
  const auto& [o, a, b] = floor_triangle;
  // From a corner through the inside, and beside it.
  CHECK(cross_any_way(floor_triangle, {o, Vector3(1, 1, 1), Vector3(1, 1, -1)}));
  CHECK_FALSE(cross_any_way(floor_triangle, {o, Vector3(-1, 1, 1), Vector3(-1, 1, -1)}));
  // Across a side: on the other side of it, folded up, and folded all the way.
  CHECK_FALSE(cross_any_way(floor_triangle, {a, o, Vector3(1, -1, 0)}));
  CHECK_FALSE(cross_any_way(floor_triangle, {a, o, Vector3(1, 1, 0x1p-60)}));
  CHECK(cross_any_way(floor_triangle, {a, o, Vector3(1, 1, 0)}));
  // The same triangle.
  CHECK(cross_any_way(floor_triangle, {b, a, o}));
}

TEST_CASE("triangle crossing: triangles without area cross nothing") {
  const TriangleCorners needle{Vector3(1, 1, -1), Vector3(1, 1, 1), Vector3(1, 1, 3)};
  const TriangleCorners point{Vector3(1, 1, 0), Vector3(1, 1, 0), Vector3(1, 1, 0)};
  const TriangleCorners across{Vector3(0, 0, 0), Vector3(1, 1, 0), Vector3(2, 2, 0)};
  for (const TriangleCorners& flat : {needle, point, across}) {
    CHECK_FALSE(cross_any_way(floor_triangle, flat));
    CHECK_FALSE(cross_any_way(flat, flat));
  }
}

}  // namespace sphparam::tests
