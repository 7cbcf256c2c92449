#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sphparam/mesh/triangle_mesh.h"

// Directions as places on the cube around the origin: its side, and s and t on it, 28 bits each.
// Their bits one by one in turn are the Morton key: a square of the cube whose side is a power of
// two holds a range of keys.

namespace sphparam {

constexpr int bits_an_axis = 28;

struct CubePlace {
  int side;            // 2·axis, +1 where negative
  std::uint32_t s, t;  // bits_an_axis bits each
};

/// A ratio from −1 to 1 in fixed point.
inline std::uint32_t in_fixed_point(double ratio) {
  constexpr double size = 1u << bits_an_axis;
  return static_cast<std::uint32_t>(std::clamp((ratio + 1) / 2 * size, 0.0, size - 1));
}

/// Requires: q finite and not zero; of any length.
inline CubePlace cube_place(const Vector3& q) {
  int axis = 0;
  const double length = q.cwiseAbs().maxCoeff(&axis);
  const int a = axis == 2 ? 0 : axis + 1, b = axis == 0 ? 2 : axis - 1;
  return {2 * axis + (q[axis] < 0), in_fixed_point(q[a] / length), in_fixed_point(q[b] / length)};
}

/// The bits of s at even places.
inline std::uint64_t spread_bits(std::uint64_t s) {
  s = (s | s << 16) & 0x0000ffff0000ffff;
  s = (s | s << 8) & 0x00ff00ff00ff00ff;
  s = (s | s << 4) & 0x0f0f0f0f0f0f0f0f;
  s = (s | s << 2) & 0x3333333333333333;
  return (s | s << 1) & 0x5555555555555555;
}

/// The bits at even places of s.
inline std::uint32_t gather_bits(std::uint64_t s) {
  s &= 0x5555555555555555;
  s = (s | s >> 1) & 0x3333333333333333;
  s = (s | s >> 2) & 0x0f0f0f0f0f0f0f0f;
  s = (s | s >> 4) & 0x00ff00ff00ff00ff;
  s = (s | s >> 8) & 0x0000ffff0000ffff;
  return static_cast<std::uint32_t>(s | s >> 16);
}

/// Neighbours along the curve of these keys are neighbours on the cube, mostly.
inline std::uint64_t morton_key(const CubePlace& place) {
  return static_cast<std::uint64_t>(place.side) << 2 * bits_an_axis | spread_bits(place.t) << 1 |
         spread_bits(place.s);
}

/// The direction of the centre of the square of keys [key, key + 2^bits).
inline Vector3 square_centre(std::uint64_t key, int bits) {
  const auto side = static_cast<int>(key >> 2 * bits_an_axis);
  const double half = std::ldexp(0.5, bits / 2), size = 1u << bits_an_axis;
  const int axis = side / 2, a = axis == 2 ? 0 : axis + 1, b = axis == 0 ? 2 : axis - 1;
  const std::uint64_t place = key & ((std::uint64_t{1} << 2 * bits_an_axis) - 1);
  Vector3 q;
  q[axis] = side % 2 ? -1 : 1;
  q[a] = 2 * (gather_bits(place) + half) / size - 1;
  q[b] = 2 * (gather_bits(place >> 1) + half) / size - 1;
  return q.normalized();
}

}  // namespace sphparam
