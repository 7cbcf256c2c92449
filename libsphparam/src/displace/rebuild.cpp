// Bilinear lookups at the corners of a fine mesh of the base.

#include "displace/rebuild.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sphparam/parallel.h"
#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 4096;

/// Between the middles of two texels of a row, also beyond the poles, where that is half a turn
/// away, and around.
double row_at(const Image& image, double x, std::int64_t row) {
  if (row < 0 || row >= image.height) {
    row = row < 0 ? -1 - row : 2 * std::int64_t{image.height} - 1 - row;
    x += image.width / 2.0;
  }
  const double left = std::floor(x), right_share = x - left;
  const auto texel = [&](double column) {
    const double around = column - image.width * std::floor(column / image.width);
    return static_cast<double>(*image.pixel(static_cast<int>(around), static_cast<int>(row)));
  };
  return (1 - right_share) * texel(left) + right_share * texel(left + 1);
}

}  // namespace

std::int64_t vertices_to_rebuild(const Image& displacement, std::int64_t mesh_vertices) {
  constexpr std::int64_t texels_a_vertex = 4, vertices_a_vertex = 2;
  const std::int64_t texels = std::int64_t{displacement.width} * displacement.height;
  return std::max(texels / texels_a_vertex, vertices_a_vertex * mesh_vertices);
}

int cuts_for(const DirectedBase& base, std::int64_t vertices) {
  constexpr double least = 2;
  // Half as many vertices as triangles, as many as quads.
  const double of_patch = base.net().degree() == 3 ? 0.5 : 1;
  const double squared = static_cast<double>(vertices) / (of_patch * base.net().patch_count());
  return static_cast<int>(std::ceil(std::max(least, std::sqrt(squared))));
}

double displacement_in(const Image& image, const Vector3& direction) {
  const SphericalCoordinates at = to_spherical(direction);
  const double x = at.theta / (2 * std::numbers::pi) * image.width - 0.5,
               y = at.phi / std::numbers::pi * image.height - 0.5;
  const double top = std::floor(y), lower_share = y - top;
  const auto row = static_cast<std::int64_t>(top);
  return (1 - lower_share) * row_at(image, x, row) + lower_share * row_at(image, x, row + 1);
}

double displacement_at(const Image& image, const TextureLattice& lattice, const TexelPoint& point) {
  const TexelPoint low = point.array().floor(), share = point - low;
  const auto at = [&](double x, double y) {
    const double last = image.width - 1, around = x < 0 ? last : x > last ? 0 : x;
    const double column = lattice.closed() ? around : std::clamp(x, 0.0, last),
                 row = std::clamp<double>(y, 0, image.height - 1);
    return static_cast<double>(*image.pixel(static_cast<int>(column), static_cast<int>(row)));
  };
  const auto mean = [&](double y) {
    return (1 - share.x()) * at(low.x(), y) + share.x() * at(low.x() + 1, y);
  };
  return (1 - share.y()) * mean(low.y()) + share.y() * mean(low.y() + 1);
}

Rebuilt rebuild(const DirectedBase& base, const Image& displacement, int cuts, int threads) {
  return rebuild(
      base,
      [&](const LimitPlace&, const Vector3& direction) {
        return displacement_in(displacement, direction);
      },
      cuts, threads);
}

Rebuilt rebuild(const DirectedBase& base, const HeightAt& heights, int cuts, int threads) {
  const auto control = static_cast<int>(base.surface().control().rows());
  Tessellation fine = tessellate(base.faces(), control, cuts);
  const std::vector<LimitPoint> points = base.surface().evaluate_all(fine.vertices, threads),
                                directions = base.directions().evaluate_all(fine.vertices, threads);
  const std::int64_t count = std::ssize(points);
  Rebuilt result;
  result.faces = std::move(fine.faces);
  for (Points* rows : {&result.mesh.positions, &result.base.positions, &result.map.points})
    rows->resize(count, 3);
  parallel_for(count, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      const LimitPoint& point = points[static_cast<size_t>(v)];
      const Vector3 direction = directions[static_cast<size_t>(v)].position.normalized();
      result.map.points.row(v) = direction;
      result.base.positions.row(v) = point.position;
      result.mesh.positions.row(v) =
          point.position +
          heights(fine.vertices[static_cast<size_t>(v)], direction) * point.normal();
    }
  });
  result.mesh.triangles = triangulate(result.mesh.positions, result.faces).triangles;
  result.base.triangles = triangulate(result.base.positions, result.faces).triangles;
  return result;
}

}  // namespace sphparam
