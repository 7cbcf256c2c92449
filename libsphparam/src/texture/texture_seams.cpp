#include "texture/texture_seams.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace sphparam {
namespace {

/// An edge of a face, from its lower vertex to its higher one.
struct Side {
  Vertex low, high;
  Face face;
  int opposite;         // corner
  int at_low, at_high;  // corners
};

Side side_of(const Triangles& triangles, Face f, int opposite) {
  int a = (opposite + 1) % 3, b = (opposite + 2) % 3;
  if (triangles(f, a) > triangles(f, b)) std::swap(a, b);
  return {triangles(f, a), triangles(f, b), f, opposite, a, b};
}

std::vector<Side> sorted_sides(const Triangles& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * static_cast<size_t>(triangles.rows()));
  for (Face f = 0; f < static_cast<Face>(triangles.rows()); ++f)
    for (int k = 0; k < 3; ++k) sides.push_back(side_of(triangles, f, k));
  std::ranges::sort(sides, {},
                    [](const Side& s) { return std::tuple(s.low, s.high, s.face, s.opposite); });
  return sides;
}

}  // namespace

SeamedTexcoords seamed(const Triangles& triangles, CornerTexcoords corners,
                       const Property* material) {
  SeamedTexcoords result{std::move(corners), {}};
  if (result.corners.rows() == 0) return result;
  result.seams.assign(static_cast<size_t>(triangles.rows()), 7);
  const auto agree = [&](const Side& a, const Side& b) {
    const auto place = [&](const Side& s, int corner) {
      return result.corners.row(3 * s.face + corner);
    };
    const auto material_of = [&](const Side& s) {
      return material ? material->values[static_cast<size_t>(s.face)] : 0;
    };
    return material_of(a) == material_of(b) && place(a, a.at_low) == place(b, b.at_low) &&
           place(a, a.at_high) == place(b, b.at_high);
  };
  const std::vector<Side> sides = sorted_sides(triangles);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const Side& s) {
      return s.low != first->low || s.high != first->high;
    });
    if (last - first == 2 && agree(first[0], first[1]))
      for (auto s = first; s != last; ++s)
        result.seams[static_cast<size_t>(s->face)] &=
            static_cast<std::uint8_t>(~(1 << s->opposite));
    first = last;
  }
  return result;
}

}  // namespace sphparam
