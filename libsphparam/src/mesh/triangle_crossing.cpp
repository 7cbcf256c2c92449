#include "mesh/triangle_crossing.h"

#include <algorithm>
#include <utility>

#include "mesh/volume_sign.h"

// Each triangle must have corners on both sides of the other's plane. What it has of that plane is
// then a piece of the line in which the planes meet, and two signs say whether the pieces overlap.
// In one plane, convex insides are apart where a side of one parts them.

namespace sphparam {
namespace {

using Signs = std::array<int, 3>;

bool is_corner(const Vector3& place, const TriangleCorners& t) {
  return place == t[0] || place == t[1] || place == t[2];
}

/// On which side of the plane of `t` the corners of `s` are.
Signs sides(const TriangleCorners& s, const TriangleCorners& t) {
  Signs signs;
  for (size_t k = 0; k < 3; ++k)
    signs[k] = is_corner(s[k], t) ? 0 : volume_sign(t[0], t[1], t[2], s[k]);
  return signs;
}

bool are_both(const Signs& signs) {
  const auto [least, most] = std::minmax({signs[0], signs[1], signs[2]});
  return least < 0 && most > 0;
}

bool are_none(const Signs& signs) { return signs == Signs{0, 0, 0}; }

/// Turns a triangle about so that the corner that is alone on its side comes first. Returns that
/// side.
int put_lone_corner_first(TriangleCorners& corners, const Signs& signs) {
  const int sum = signs[0] + signs[1] + signs[2];
  const int lone = sum > 0 ? -1 : 1;  // of +, 0, − either
  const auto first = std::find(signs.begin(), signs.end(), lone) - signs.begin();
  std::rotate(corners.begin(), corners.begin() + first, corners.end());
  return lone;
}

/// Requires: both have corners on both sides of the other's plane.
bool overlap_on_line(TriangleCorners s, const Signs& of_s, TriangleCorners t, const Signs& of_t) {
  const int side_of_s = put_lone_corner_first(s, of_s), side_of_t = put_lone_corner_first(t, of_t);
  if (side_of_s < 0) std::swap(t[1], t[2]);
  if (side_of_t < 0) std::swap(s[1], s[2]);
  return volume_sign(s[0], s[1], t[0], t[1]) < 0 && volume_sign(s[0], s[2], t[2], t[0]) < 0;
}

/// Whether a side of `s`, which runs as `turn` says, has all of `t` beyond it or on it.
bool parts(const TriangleCorners& s, int turn, const TriangleCorners& t, int axis) {
  for (size_t k = 0; k < 3; ++k) {
    const bool are_beyond = std::ranges::all_of(t, [&](const Vector3& corner) {
      return turn * area_sign(s[k], s[(k + 1) % 3], corner, axis) <= 0;
    });
    if (are_beyond) return true;
  }
  return false;
}

/// Requires: one plane, or no area.
bool overlap_in_plane(const TriangleCorners& s, const TriangleCorners& t) {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn_of_s = area_sign(s[0], s[1], s[2], axis);
    if (turn_of_s == 0) continue;
    const int turn_of_t = area_sign(t[0], t[1], t[2], axis);
    return turn_of_t != 0 && !parts(s, turn_of_s, t, axis) && !parts(t, turn_of_t, s, axis);
  }
  return false;
}

}  // namespace

bool triangles_cross(const TriangleCorners& s, const TriangleCorners& t) {
  const Signs of_s = sides(s, t);
  if (are_none(of_s)) return are_none(sides(t, s)) && overlap_in_plane(s, t);
  if (!are_both(of_s)) return false;
  const Signs of_t = sides(t, s);
  return are_both(of_t) && overlap_on_line(s, of_s, t, of_t);
}

}  // namespace sphparam
