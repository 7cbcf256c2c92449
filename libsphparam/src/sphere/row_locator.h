#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "sphparam/sphere/sphere_locator.h"

namespace sphparam {

/// Numbers that are read and written some beyond their end: eight at a time.
using PaddedNumbers = std::vector<double>;
inline constexpr size_t padding = 8;

/// Directions, a component at a time.
struct DirectionTable {
  explicit DirectionTable(size_t count);
  Vector3 operator[](size_t i) const { return {x[0][i], x[1][i], x[2][i]}; }
  size_t count;
  std::array<PaddedNumbers, 3> x;
};

/// Points of a surface, a component at a time.
struct PointTable {
  explicit PointTable(size_t count);
  SurfacePoint operator[](size_t i) const {
    return {faces[i], {barycentric[0][i], barycentric[1][i], barycentric[2][i]}};
  }
  void set(size_t i, const SurfacePoint& point);
  size_t count;
  std::vector<Face> faces;
  std::array<PaddedNumbers, 3> barycentric;
};

/// Locates directions each of which is near the one before, as along a row of an image.
///
/// Eight at a time are held against the triangle of the last one, so that a triangle is read once
/// for all directions of the row that it holds. Where triangles are hardly larger than the distance
/// of directions, `SphereLocator::locate_all` does it. Our own.
class RowLocator {
 public:
  /// The locator outlives this.
  explicit RowLocator(const SphereLocator& locator) : locator_(locator) {}

  /// Requires: as SphereLocator::locate; as many points as directions. Ensures: the same points,
  /// but for the last bits of weights. Cost: some 2 ns each where triangles are ten directions
  /// wide.
  void locate(const DirectionTable& directions, PointTable& points) const;

 private:
  bool is_fine(const DirectionTable& directions) const;
  void locate_each(const DirectionTable& directions, PointTable& points) const;
  size_t settle(std::int32_t cell, const DirectionTable& directions, size_t first,
                PointTable& points) const;

  const SphereLocator& locator_;
};

}  // namespace sphparam
