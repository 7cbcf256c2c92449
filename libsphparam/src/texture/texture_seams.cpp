#include "texture/texture_seams.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace sphparam {
namespace {

constexpr double rounding = 1e-6;  // of coordinates of one place
// The bits of corner 0's side.
constexpr unsigned seam = 1, seam_unless_repeated = 8, no_seam = 0;

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

/// How coordinates differ across an edge, by what they do at its two ends.
unsigned seam_of(const Eigen::RowVector2d& low, const Eigen::RowVector2d& high) {
  const Eigen::RowVector2d images = low.array().round();
  const auto are_images = [&](const Eigen::RowVector2d& apart) {
    return ((apart - images).array().abs() <= rounding).all();
  };
  if (!are_images(low) || !are_images(high)) return seam;
  return images.isZero(0) ? no_seam : seam_unless_repeated;
}

}  // namespace

SeamedTexcoords seamed(const Triangles& triangles, CornerTexcoords corners,
                       const Property* material) {
  SeamedTexcoords result{std::move(corners), {}};
  if (result.corners.rows() == 0) return result;
  result.seams.assign(static_cast<size_t>(triangles.rows()), 7 * seam);
  const auto seam_between = [&](const Side& a, const Side& b) {
    const auto place = [&](const Side& s, int corner) {
      return result.corners.row(3 * s.face + corner);
    };
    const auto material_of = [&](const Side& s) {
      return material ? material->values[static_cast<size_t>(s.face)] : 0;
    };
    if (material_of(a) != material_of(b)) return seam;
    return seam_of(place(a, a.at_low) - place(b, b.at_low),
                   place(a, a.at_high) - place(b, b.at_high));
  };
  const std::vector<Side> sides = sorted_sides(triangles);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const Side& s) {
      return s.low != first->low || s.high != first->high;
    });
    const unsigned found = last - first == 2 ? seam_between(first[0], first[1]) : seam;
    for (; first != last; ++first) {
      std::uint8_t& seams = result.seams[static_cast<size_t>(first->face)];
      seams = static_cast<std::uint8_t>((seams & ~(seam << first->opposite)) |
                                        found << first->opposite);
    }
  }
  return result;
}

}  // namespace sphparam
